// How a light sends out photons, found by running its shader: where it stands, how much goes where, and what
// that comes to. Shapes, cookies, barn doors and textures so count as the shader has them.
//
// A light may stand at a point (illuminate), at the points of a surface (AreaLightSource) or far away
// (solar); of the first the fall-off must be that of the square of the distance, of the second there must be
// none, as photons spread out in this way by themselves (Christensen, 3.5.1). In camera space.
#pragma once

#include "render/state/math.h"
#include "slvm/machine.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace render {

/// A sphere round all that photons can hit.
struct SceneSphere {
  Vec3 centre{0.0f};
  float radius = 1;
};

/// What leaves a light. Power as in photon_map.h.
struct EmittedPhotons {
  std::vector<Vec3> origin, direction;
  std::vector<Color> power;
};

class LightEmission {
public:
  /// Runs the light; all arguments must outlive this.
  LightEmission(const slvm::Machine& machine, slvm::RendererServices& services, const slvm::Instance& light,
                const SceneSphere& scene);

  /// All that it sends into the scene; 0: nothing, or it cannot send photons.
  Color power() const { return power_; }
  /// Why no photons can be sent, or how they will not be right; "".
  const std::string& problem() const { return problem_; }
  /// Photons `first` to `first + count` of `all` that it sends.
  EmittedPhotons emit(size_t first, size_t count, size_t all, uint64_t seed) const;

private:
  static constexpr int kRows = 64, kColumns = 128; ///< of the lattice that is looked at

  /// Points of an area light's surface, by what LightEmitter::place() takes, and the normals there.
  struct Places {
    std::vector<float> x, y;
    std::vector<Vec3> P, N;
  };
  /// Light at points: L from the light, and Cl; of an area light from a place for each of them.
  void run(const std::vector<Vec3>& points, std::vector<Vec3>& L, std::vector<Color>& Cl,
           const Places* places = nullptr) const;
  void find_normals(Places& places) const;
  /// What is seen of an area light in the directions of the lattice, `each` rows and columns apart, at `part`
  /// of its reach from a place.
  void look_from_place(float x, float y, float part, int each, std::vector<Color>& Cl) const;
  std::vector<Color> lattice_colours() const;
  void find_place();
  void look_at_layer(int n, int k, std::vector<Vec3>& lit, std::vector<Vec3>& from) const;
  void find_distribution();
  bool check_fall_off();
  Vec3 direction_at(float row, float column) const;
  Vec3 on_disc(float x, float y) const;

  const slvm::Machine& machine_;
  slvm::RendererServices& services_;
  const slvm::Instance& light_;
  SceneSphere scene_;
  enum class Kind : uint8_t { kNone, kPoint, kSurface, kDistant } kind_ = Kind::kNone;
  Vec3 from_{0.0f};               ///< the point, or the direction of the light
  float reach_ = 1;               ///< distance from the point at which it is looked at
  std::vector<double> cumulated_; ///< of the cells' shares
  Color power_{0.0f};
  std::string problem_;
};

} // namespace render
