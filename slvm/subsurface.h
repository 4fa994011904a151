// What subsurface() asks of a renderer: the light that leaves a surface after it was scattered below, from a
// cloud of points that were lit before, for all points of a grid at once. PUBLIC, abstract: stdlib/scattering
// implements it; so can an embedder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

/// A lookup for many points. Lengths in positions are the scene's, those of the material millimetres.
struct SubsurfaceLookup {
  /// A number at each point, or one for all.
  using Numbers = std::vector<float>;
  static float at(const Numbers& values, size_t point) { return values[values.size() == 1 ? 0 : point]; }

  std::string_view cloud; ///< as the shader names it; never empty

  /// How the material is said.
  enum class Form : uint8_t {
    kNamed,        ///< `material`, of those that were measured
    kCoefficients, ///< first: reduced scattering, second: absorption [1/mm]
    kAppearance,   ///< first: albedo under diffuse light, second: diffuse mean free path [mm]
    kOfPoints      ///< the albedos of the cloud's points, second as above (of one for all: the first point's)
  };
  Form form = Form::kNamed;
  std::string_view material;
  Numbers first[3], second[3]; ///< by colour
  float eta = 0;               ///< index of refraction; 0: the material's, or what is usual
  float millimetres = 1;       ///< of a unit of the scene
  /// Groups of samples under a smaller solid angle than this stand for their members; negative: what is
  /// usual.
  float max_solid_angle = -1;
  bool smooth = false;       ///< without edges where groups begin to stand for their members
  float follow_topology = 0; ///< 0 to 1: how far light is kept from crossing air in folds

  size_t points = 0;
  const uint64_t* mask = nullptr; ///< a bit a point, 64 a word: points that are off need no result
  std::vector<float> position[3]; ///< in the space of the cloud
  std::vector<float> normal[3];   ///< in the same, of any length
  float* result[3] = {}; ///< `points` floats a colour, to be filled in: like diffuse(), without Fresnel terms

  bool active(size_t point) const { return (mask[point / 64] >> (point % 64) & 1) != 0; }
};

/// Calls come from many threads at once.
class SubsurfaceServices {
public:
  virtual ~SubsurfaceServices() = default;

  /// "", or why there is nothing to be seen (results are then 0), or what else went wrong.
  virtual std::string subsurface(const SubsurfaceLookup&) = 0;
};

} // namespace slvm
