// surfacecells(): cells round the points of a cloud, on a surface that has no parameters of its own; what
// Voronoi patterns are made of (E. Tomson, the course's 5.5).
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/point_cloud.h"

#include <map>
#include <memory>
#include <mutex>

namespace subsurface_plugin {
namespace {

using subsurface::PointOctree;

/// The points of a frame's clouds.
struct FramePoints {
  static constexpr const char* kName = "anemone.subsurface.cells";
  void end(RixContext&) {}

  slvm::Result<std::shared_ptr<const PointOctree>> get(const std::string& file) {
    std::lock_guard lock(mutex);
    if (auto found = trees.find(file); found != trees.end()) return found->second;
    auto read = [&]() -> slvm::Result<std::shared_ptr<const PointOctree>> {
      auto cloud = subsurface::read_point_cloud(file);
      if (!cloud) return slvm::Error{cloud.error()};
      if (cloud->size() < 2) return slvm::Error{file + ": cells need two points or more"};
      return std::make_shared<const PointOctree>(cloud->position);
    };
    return trees.emplace(file, read()).first->second;
  }

  std::mutex mutex;
  std::map<std::string, slvm::Result<std::shared_ptr<const PointOctree>>> trees;
};

} // namespace

// unused, cloud, P, nearest, second, centre
int surface_cells(RslContext* context, int argc, const RslArg* argv[]) {
  RslStringIter file(argv[1]);
  RslPointIter P(argv[2]), centre(argv[5]);
  RslFloatIter nearest(argv[3]), second(argv[4]);
  const auto tree = of_frame<FramePoints>(*context).get(*file);
  if (!tree) complain(*context, tree.error());
  std::vector<PointOctree::Near> near;
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv); ++i, ++P, ++nearest, ++second, ++centre) {
    *nearest = *second = 0;
    store(subsurface::Vec3{}, *centre);
    const subsurface::Vec3 x = vec3(*P);
    if (!tree || !is_finite(x)) continue;
    (*tree)->nearest(x, 2, near);
    *nearest = std::sqrt(near[0].distance2);
    *second = std::sqrt(near[1].distance2);
    store((*tree)->positions()[near[0].place], *centre);
  }
  return 0;
}

} // namespace subsurface_plugin
