// What plug-ins ask of a renderer about files of points: writing points with values of their own, and finding
// those values again near other points. PUBLIC, abstract: stdlib/scattering implements it; so can an
// embedder.
#pragma once

#include "slvm/format/types.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

/// Points, all in one space, with the same channels. Lengths are those of the space.
struct CloudPoints {
  /// Values by name: a float, or a color, point, vector or normal, which is three numbers.
  struct Channel {
    std::string name;
    Type type = Type::kFloat;
    std::vector<float> values[3]; ///< by component, then point; of a float the first alone
  };

  std::string_view file; ///< as the shader or plug-in names it; never empty
  std::vector<float> position[3];
  std::vector<float> normal[3]; ///< of any length; 0: the point faces no way
  /// Written: of the disc that a point stands for. Read: how far away points count, 0: the nearest ones do.
  std::vector<float> radius;
  std::vector<Channel> channels;

  size_t size() const { return position[0].size(); }
};

/// Calls come from many threads at once. They return "" or what went wrong.
class PointCloudServices {
public:
  virtual ~PointCloudServices() = default;

  /// Adds points to a file, which is written when the frame ends. All calls of a frame must bring the same
  /// channels for it.
  virtual std::string bake(const CloudPoints& points) = 0;
  /// Fills in the channels at each point, and whether there was anything near it; elsewhere they keep what
  /// they were. Files are as they were when the frame began.
  virtual std::string look_up(CloudPoints& points, std::vector<char>& found) = 0;
};

} // namespace slvm
