// What irradiancecache() asks of a renderer: to keep values of shading points in files, and to find values
// between those that a file holds, for all points of a grid at once. PUBLIC, abstract: render/caches
// implements it; so can an embedder.
//
// Irradiance is what indirectdiffuse() returns: the mean of the light that arrives, so that a white matte
// surface shows it as it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

/// Where. Positions, normals and directions are in the space that the data are kept in ("coordsystem").
struct IrradiancePoints {
  std::string_view file; ///< as the shader names it; never empty
  size_t points = 0;
  const uint64_t* mask = nullptr; ///< a bit a point, 64 a word: points that are off are not there
  std::vector<float> position[3];
  std::vector<float> normal[3]; ///< length 1, or 0

  bool active(size_t point) const { return (mask[point / 64] >> (point % 64) & 1) != 0; }
};

/// irradiancecache("insert"). Of values that are not given the vectors are empty.
struct IrradianceInsert : IrradiancePoints {
  bool keeps = false; ///< mode "rw": to what the file holds already; else the file begins anew with the frame
  /// From each point to the farthest of its neighbours on the grid; 0 where there are none.
  std::vector<float> spacing;
  std::vector<float> occlusion, irradiance[3], direction[3];
};

/// irradiancecache("query"). The file is the one that was there when the frame began. What is not asked for
/// is null.
struct IrradianceQuery : IrradiancePoints {
  /// Values are not used where they may be wrong by more than this part (Attribute "irradiance" "maxerror");
  /// negative: wherever there are any.
  float max_error = -1;
  float* occlusion = nullptr;
  float *irradiance[3] = {}, *direction[3] = {};
  float* found = nullptr; ///< 1, or 0 where the file holds nothing: results are then 0
};

/// Calls come from many threads at once.
class IrradianceCacheServices {
public:
  virtual ~IrradianceCacheServices() = default;

  /// "" or what went wrong; results of queries are set all the same.
  virtual std::string insert(const IrradianceInsert&) = 0;
  virtual std::string query(const IrradianceQuery&) = 0;
};

} // namespace slvm
