// Lights on a grid: what they emit, kept while the points they light stay the same, and the loops over them.
#pragma once

#include "slvm/exec/bound.h"
#include "slvm/wide/mask.h"

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

class ShaderRun;
struct GridState;
struct KernelTable;

/// What one illuminate or solar block gave (or, for an ambient light, the whole shader), at every point.
struct Emission {
  PlaneMemory memory;        ///< -L, and where it cannot stay with the run: L, Cl, Ol
  std::vector<MaskWord> lit; ///< points inside the cone
  Planes to_light, from_light, colour, opacity;
  bool distant = false; ///< parallel light: L is a direction, no way to the light
};

/// The kernels lights are computed with, found once.
struct LightKernels {
  explicit LightKernels(const KernelTable& kernels);
  Kernel subtract, negate, normalize, in_cone;
};

/// A value that a light loop sends to its lights: for these the parameter of this name, if they have one of
/// the same type.
struct SentValue {
  std::string name;
  Planes planes;
  PlaneMemory memory;
};

/// Which run of a light this is.
struct LightSample {
  uint32_t light = 0;  ///< its number among the lights that are on
  uint32_t sample = 0; ///< of an area light, which of its points for each lit one
};

/// One light's results for one set of points; of an area light, those of one of its samples.
struct LitGrid {
  std::unique_ptr<ShaderRun> run;      ///< kept for lightsource()
  std::vector<float> position, normal; ///< the points and normals it ran for
  std::unique_ptr<Grid> on_emitter;    ///< of an area light: the points of its surface
  LightSample sample;
  const Instance* light = nullptr;
  uint64_t light_id = 0;
  uint64_t last_use = 0; ///< when it was asked for, by LightCache's count
};

/// The lights' results on the grid being shaded, and memory for them from grid to grid.
class LightCache {
public:
  LightCache();
  ~LightCache();
  void clear() { used_ = 0; }
  /// What `light` gives at `position` with `normal`: run now, unless it was for the same points with nothing
  /// sent.
  LitGrid& light(GridState& state, const ShaderRun& by, const Instance& light, LightSample sample,
                 const Operand& position, const Operand& normal, std::span<const SentValue> sent = {});

private:
  /// For how many sets of points what a light gives is kept. Shaders that march through a volume come to new
  /// ones at each step: to keep all of it would take more from the processor's caches than it saves.
  static constexpr size_t kKept = 4;

  /// A place for the next run of a light, with registers of an earlier one if there are any.
  LitGrid& place_for(uint64_t light_id, uint32_t sample);
  /// The light with all its parameters as variables: a specialised one has values in its code.
  const Instance& open(const Machine&, const Instance&);

  std::map<uint64_t, std::unique_ptr<const Instance>> open_;
  std::vector<std::unique_ptr<LitGrid>> grids_;
  size_t used_ = 0;
  uint64_t uses_ = 0;
};

/// A loop over the emissions of the lights of a category.
class LightLoop {
public:
  /// Finds the lights and runs them.
  void begin(ShaderRun& run, std::string_view category, const Operand& position, const Operand* axis,
             const Operand* angle);
  /// Makes the next emission that reaches lanes of `in_loop` the current one: binds L, Cl and Ol. False: none
  /// left.
  bool next(ShaderRun& run, const MaskWord* in_loop);
  const MaskWord* lanes() const { return lanes_.data(); }
  /// The light of this round, for lightsource(); null outside a loop.
  const LitGrid* current() const { return current_; }
  /// The light of this round is infinitely far away.
  bool is_distant() const { return distant_; }
  void end() { current_ = nullptr; }
  /// What later loops send to their lights, until send_nothing().
  void send(std::string_view name, Type type, uint32_t elements, const Operand& value, size_t pitch);
  void send_nothing() { sent_.clear(); }

private:
  static bool category_matches(std::string_view wanted, std::span<const std::string> categories);

  std::vector<SentValue> sent_;
  std::vector<std::pair<LitGrid*, const Emission*>> rounds_;
  size_t at_ = 0;
  const LitGrid* current_ = nullptr;
  bool distant_ = false;
  Operand axis_, angle_;
  bool has_cone_ = false;
  std::vector<MaskWord> lanes_;
  PlaneMemory inside_;
  float cosine_[kMaxLanes];
};

/// The lanes of a light cone: sets L of the run (from `from` to Ps) and stores the lanes inside into `lit`.
void begin_illuminate(ShaderRun& run, const Operand& from, const Operand* axis, const Operand* angle,
                      std::vector<MaskWord>& lit);
void begin_solar(ShaderRun& run, const Operand* axis, const Operand* angle, std::vector<MaskWord>& lit);
/// Records what the block gave in the lanes that entered it.
void end_emission(ShaderRun& run, const std::vector<MaskWord>& lit);
/// At the end of a light: an ambient one's emission is what it set; a lone block's colour is the one at the
/// end, for lights that finish it after their block.
void end_light(ShaderRun& run);

} // namespace slvm
