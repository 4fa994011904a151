// The loops of gather() and traverse(). The call before a loop says which rays there are (GatherLoop::begin),
// each round is one ray of every point that still has one, and what rays bring is read by gatherhit() and
// gathered().
//
// Where no lane can leave the loop early, all its rays are traced ahead, in batches of kRaysAtOnce; else each
// round traces its own, so that no ray is shot that nobody sees.
#pragma once

#include "slvm/exec/rays/ray_buffer.h"

namespace slvm {

/// Enough for hits to be shaded together, few enough to stay in the cache.
inline constexpr size_t kRaysAtOnce = 1 << 14;

/// A variable that the rays of a loop set.
struct RayValue {
  enum class Of : uint8_t {
    kHit, ///< what the renderer finds there
    kOrigin,
    kDirection,
    kLength,
    kBias,
    kRandomPair,
    kMapColour,
    kMapDirection,
    kMapSolidAngle
  };
  Of of = Of::kHit;
  uint32_t token = 0; ///< its name as a string of the machine
  RayOutput output;   ///< kHit: data and found are set for each batch
  std::vector<float> data;
  std::vector<uint8_t> found;
};

class GatherLoop {
public:
  enum class Form : uint8_t { kGather, kTraverse };
  void begin(const GridCall& call, Form form);
  /// The loop itself begins. `lanes_leave`: some may before their last ray.
  void start(bool lanes_leave);
  /// Goes to the next ray that lanes of `in_loop` have. False: there is none.
  bool next(ShaderRun& run, const MaskWord* in_loop);
  /// Of this round.
  const MaskWord* lanes() const { return lanes_.data(); }
  const MaskWord* hits() const { return hits_.data(); }
  /// gathered(): the value its name stands for, where this round's rays bring one.
  void store_value(const GridCall& call) const;
  bool scattered() const { return source_.scattered() || from_map_; }

private:
  /// "": shooting rays as usual.
  enum class Mode : uint8_t { kRays, kPattern, kMapSamples };

  void read_category(std::string_view category);
  void read_spec(const GridCall& call, const CallTokens& tokens, RaySpec& spec);
  void read_values(const GridCall& call, const CallTokens& tokens);
  bool next_sample(ShaderRun& run, const MaskWord* in_loop);
  bool next_surface(ShaderRun& run, const MaskWord* in_loop);
  void make_samples(ShaderRun& run, const MaskWord* in_loop);
  void draw_from_map(ShaderRun& run);
  void trace(ShaderRun& run, RayCursor* cursors);
  void enter_round(const ShaderRun& run, size_t first, size_t last, bool unshot_miss);
  void store_found(const RayValue& value, const Operand& out, size_t planes) const;
  std::vector<uint32_t> places_in(const MaskWord* in_loop) const;

  Form form_ = Form::kGather;
  Mode mode_ = Mode::kRays;
  RaySource source_;
  RayOptions options_;
  std::string_view map_;
  bool from_map_ = false; ///< directions as the light of map_ comes
  float attribute_bias_ = 0;
  uint32_t code_ = 0; ///< of the call, for messages
  std::vector<RayValue> values_;

  bool lanes_leave_ = false;
  uint32_t round_ = 0, traced_to_ = 0; ///< samples; rounds before traced_to_ are in the buffer
  RayBuffer rays_;
  std::vector<float> distance_, density_, colour_[3];
  std::vector<RayCursor> cursors_; ///< by place in the source
  std::vector<uint8_t> ended_;     ///< by place: no further surface
  size_t first_ = 0, last_ = 0;    ///< this round's rays
  std::vector<MaskWord> lanes_, hits_;
};

} // namespace slvm
