// Files of points with values, written and read during a frame: PLY, as point_cloud.h has them. One for each
// frame.
//
// A channel "heat" of floats is the property heat; a color "tint" is tint_r, tint_g and tint_b, a point,
// vector or normal "flow" is flow_x, flow_y and flow_z. The radius is kept as the area of the disc. Files by
// bakepoints() and lightpoints have the colors "irradiance" and "albedo" and the float "area".
#pragma once

#include "slvm/point_clouds.h"
#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/point_cloud.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace subsurface {

class BakedClouds : public slvm::PointCloudServices {
public:
  /// `find` turns the name of a file that is read into a path.
  explicit BakedClouds(std::function<std::string(std::string_view)> find = {}) : find_(std::move(find)) {}

  std::string bake(const slvm::CloudPoints& points) override;
  std::string look_up(slvm::CloudPoints& points, std::vector<char>& found) override;
  /// Writes what was baked, in an order that does not depend on that of the calls. What went wrong, a
  /// sentence for each file.
  std::vector<std::string> finish();

private:
  struct Read {
    std::mutex turn; ///< of who reads it
    bool known = false;
    std::string problem;
    PointCloud cloud;
    PointOctree tree;
  };
  std::shared_ptr<const Read> read(std::string_view file);

  std::function<std::string(std::string_view)> find_;
  std::mutex mutex_;
  std::map<std::string, PointCloud, std::less<>> written_;
  std::map<std::string, std::shared_ptr<Read>, std::less<>> read_;
};

/// Files that can only be read: for programs that run shaders several times, which would write as many
/// points.
class ReadClouds : public BakedClouds {
public:
  using BakedClouds::BakedClouds;
  std::string bake(const slvm::CloudPoints&) override {
    return "this program writes no points; slrender does";
  }
};

} // namespace subsurface
