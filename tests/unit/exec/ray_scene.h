// A scene of spheres and planes that traces rays one by one, by their formulas, and remembers what it was
// asked: what the tests of rays compare with.
#pragma once

#include "tests/unit/exec/shading.h"

#include <array>
#include <mutex>
#include <set>

namespace slvm::test {

using Vec = std::array<double, 3>;

struct TestSurface {
  bool sphere = true;
  Vec at{};            ///< centre, or a point of the plane
  Vec normal{0, 0, 1}; ///< of the plane
  double radius = 1;
  std::array<float, 3> colour{1, 1, 1}, opacity{1, 1, 1};
  std::map<std::string, Value, std::less<>>
      variables; ///< by "surface:name", "primitive:name", "attribute:name"
  std::string group;
};

/// One ray as it was asked for.
struct AskedRay {
  Vec origin{}, direction{}, weight{1, 1, 1};
  double max_distance = std::numeric_limits<double>::infinity(), bias = -1;
  uint32_t point = 0, sample = 0;
  bool has_differentials = false;
  Vec origin_du{}, origin_dv{}, direction_du{}, direction_dv{};
};

/// One call, without its rays.
struct AskedCall {
  RayKind kind = RayKind::kSpecular;
  HitSides sides = HitSides::kBoth;
  HitMode mode = HitMode::kDefault;
  std::string label, subset;
  bool shades = true, transmission = false, wants_distance = true;
  uint32_t seed = 0;
  size_t rays = 0;
  std::vector<std::string> outputs;
};

/// What occlusion() or indirectdiffuse() asked, with the arrays' values at point 0.
struct AskedHemisphere {
  AskedCall call;
  float samples = 0, min_samples = 0, falloff = 0, max_error = 0, max_pixel_distance = 0;
  bool cosine = true, power = false, wants_radiance = false, wants_occlusion = false, wants_colour = false,
       wants_direction = false;
  double cone_angle = 0, max_distance = 0, bias = 0, sample_base = 0; ///< -7: null
  Vec position{}, normal{}, along_u{}, along_v{}, weight{1, 1, 1};
  std::string map, cache_space;
  Matrix4 to_map;
  std::vector<uint8_t> active;
};

class RayScene : public RayServices {
public:
  std::vector<TestSurface> surfaces;
  std::set<uint32_t> too_deep; ///< samples that are not shot
  double self_distance = 1e-3; ///< the bias where none is given
  bool known_empty = false;

  std::vector<AskedRay> rays;
  std::vector<AskedCall> calls;
  std::vector<AskedHemisphere> hemispheres;
  std::string map_problem;

  bool is_empty() override { return known_empty; }
  void trace(const ShadingState&, const RayOptions&, const RayBatch&, std::span<const RayOutput>,
             float* distance, RayCursor*) override;
  void transmission(const ShadingState&, const RayOptions&, const RayBatch&,
                    float* const (&through)[3]) override;
  std::string hemisphere(const ShadingState&, const HemisphereQuery&) override;
  /// A map that is bright in +y only: directions about it, with density 1 / PI.
  std::string sample_environment(const ShadingState&, const EnvironmentSamples&) override;

  void forget() {
    rays.clear();
    calls.clear();
    hemispheres.clear();
  }

private:
  struct Meeting {
    double distance;
    uint32_t surface;
    uint32_t face; ///< of a sphere: 0 where the ray comes in, 1 where it leaves
  };
  std::vector<Meeting> meetings(const AskedRay&, const RayOptions&) const;
  void bring(const RayOutput&, size_t r, const AskedRay&, const Meeting&) const;
  void note(const RayOptions&, const RayBatch&, std::span<const RayOutput>, bool transmission);

  std::mutex mutex_;
};

class RayServicesScene : public TableServices {
public:
  RayScene scene;
  bool traces = true;
  std::map<std::string, Value, std::less<>> options;

  RayServices* rays() override { return traces ? &scene : nullptr; }
  bool option(const ShadingState&, std::string_view name, Value& out) override {
    auto it = options.find(name);
    if (it != options.end()) out = it->second;
    return it != options.end();
  }
};

/// The plane z = `z`, of this colour.
TestSurface plane_at(double z, std::array<float, 3> colour = {1, 1, 1});
TestSurface sphere_at(Vec centre, double radius, std::array<float, 3> colour = {1, 1, 1});

} // namespace slvm::test
