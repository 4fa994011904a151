// What photonmap() asks of a renderer: the light that photons of a map bring to points of surfaces, for all
// points of a grid at once. PUBLIC, abstract: render/photons implements it; so can an embedder.
//
// The light is what diffuse() and indirectdiffuse() return, and all of it: a white matte surface shows it as
// it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

struct PhotonLookup {
  std::string_view file;                                       ///< as the shader names it; never empty
  size_t photons = 50;                                         ///< that an estimate is made of, at most
  float max_distance = std::numeric_limits<float>::infinity(); ///< farther photons do not count
  float min_depth = 0;   ///< photons that were scattered less often do not count
  bool radiance = false; ///< instead: what leaves the surface at the nearest photon
  size_t points = 0;
  const uint64_t* mask = nullptr; ///< a bit a point, 64 a word: points that are off need no result
  std::vector<float> position[3]; ///< in "world"
  std::vector<float> normal[3];   ///< the side that is lit, length 1, or 0; empty: both sides count
  float* result[3] = {};          ///< `points` floats a colour, to be filled in

  bool active(size_t point) const { return (mask[point / 64] >> (point % 64) & 1) != 0; }
};

/// Calls come from many threads at once.
class PhotonMapServices {
public:
  virtual ~PhotonMapServices() = default;

  /// "", or why there is nothing to be seen: results are then 0.
  virtual std::string photon_map(const PhotonLookup&) = 0;
};

} // namespace slvm
