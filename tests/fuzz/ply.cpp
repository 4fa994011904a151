// PLY files from anywhere: as a point cloud, which is written and read again, looked up and thinned, and as a
// mesh, over which points are spread.
#include "stdlib/subsurface/diffusion_tree.h"
#include "stdlib/subsurface/grid_points.h"
#include "stdlib/subsurface/repulsion.h"
#include "stdlib/subsurface/scatter_map.h"

#include <cstdio>
#include <cstdlib>

namespace {

using namespace subsurface;

void demand(bool fine, const char* what) {
  if (fine) return;
  std::fprintf(stderr, "ply: %s\n", what);
  std::abort();
}

void use_cloud(PointCloud cloud) {
  cloud.channels.clear(); // names of channels need not be words that can be written
  for (PlyEncoding encoding : {PlyEncoding::kBinary, PlyEncoding::kAscii}) {
    const auto bytes = format_point_cloud(cloud, encoding);
    demand(static_cast<bool>(bytes), "what was read cannot be written");
    const auto again = parse_point_cloud(*bytes, "again.ply");
    demand(again && again->position == cloud.position && again->area == cloud.area,
           "writing changes a cloud");
  }
  if (cloud.area.empty()) return;
  static_cast<void>(ScatterMap::build(cloud));
  demand(check(thin(cloud, 5)).empty() || cloud.total_area() > 1e30, "thinning spoils a cloud");
  if (cloud.irradiance.empty()) return;
  const auto tree = DiffusionTree::build(cloud);
  demand(static_cast<bool>(tree), "no tree of a sound cloud");
  static const DiffusionMaterial marble(dipole_of(medium_of(*find_material("marble"))));
  for (float epsilon : {0.0f, 0.1f})
    static_cast<void>(tree->exitance(marble, {1, 2, 3}, {epsilon, {0, 10, 0.2f}}));
  static_cast<void>(tree->exitance(DiffusionMaterial(*tree, {1, 2, 3}, 1.3), {0, 0, 0}));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  auto cloud = parse_point_cloud(bytes, "fuzz.ply");
  if (!cloud || cloud->size() > 5000) return 0;
  use_cloud(std::move(*cloud));
  auto mesh = parse_mesh(bytes, "fuzz.ply");
  if (!mesh || mesh->triangles.size() > 500) return 0;
  weld(*mesh);
  const MeshPlane plane(*mesh);
  RepulsionOptions options;
  options.points = 20;
  options.passes = 2;
  options.threads = 1;
  for (const SurfacePoint& p : repel(plane, options))
    demand(p.triangle < mesh->triangles.size(), "a point off the mesh");
  return 0;
}
