// bakepoints: a point for each micropolygon of the grids that call it, written as a cloud when the frame ends
// (the course's 4.4).
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/subsurface/grid_points.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <numeric>

namespace subsurface_plugin {
namespace {

using namespace subsurface;

/// In an order that does not depend on which grid came first.
void sort_points(PointCloud& cloud) {
  std::vector<size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), size_t{0});
  auto key = [&](size_t i) {
    const Vec3 p = cloud.position[i], n = cloud.normal[i];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, cloud.area[i]);
  };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  auto arrange = [&](auto& column) {
    if (column.empty()) return;
    auto before = column;
    for (size_t i = 0; i < order.size(); ++i)
      column[i] = before[order[i]];
  };
  arrange(cloud.position);
  arrange(cloud.normal);
  arrange(cloud.area);
  arrange(cloud.irradiance);
  arrange(cloud.albedo);
}

/// The clouds of a frame, by file.
struct BakedClouds {
  static constexpr const char* kName = "anemone.subsurface.baked";
  void end(RixContext& context) {
    for (auto& [file, cloud] : clouds) {
      sort_points(cloud);
      if (auto written = write_point_cloud(file, cloud); !written) complain(context, written.error());
    }
  }

  std::mutex mutex;
  std::map<std::string, PointCloud> clouds;
};

void append(PointCloud& to, const PointCloud& from) {
  auto add = [](auto& column, const auto& more) { column.insert(column.end(), more.begin(), more.end()); };
  add(to.position, from.position);
  add(to.normal, from.normal);
  add(to.area, from.area);
  add(to.irradiance, from.irradiance);
  add(to.albedo, from.albedo);
}

std::vector<Vec3> values_of(const RslArg* arg, size_t points) {
  float* data = nullptr;
  int stride = 0;
  arg->GetData(&data, &stride);
  std::vector<Vec3> out(points);
  for (size_t i = 0; i < points; ++i)
    out[i] = vec3(data + i * static_cast<size_t>(stride));
  return out;
}

} // namespace

int bake_points(RslContext* context, int argc, const RslArg* argv[]) {
  auto* grid = static_cast<RixGrid*>(context->GetRixInterface(k_RixGrid));
  int columns = 0, rows = 0;
  // What rays hit has no micropolygons, and is not to be baked anyway.
  if (!grid || !grid->Size(&columns, &rows)) return 0;
  unsigned int points = 0;
  const RslRunFlag* active = context->GetRunFlags(&points);
  std::vector<Vec3> position = values_of(argv[2], points);
  // Micropolygons with a corner that does not run the call are none.
  for (size_t i = 0; i < points; ++i)
    if (!active[i]) position[i].x = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3> normal = values_of(argv[3], points), albedo = values_of(argv[4], points);
  const std::vector<Vec3> irradiance = argc > 5 ? values_of(argv[5], points) : std::vector<Vec3>();
  RslStringIter file(argv[1]);
  if (!**file) {
    complain(*context, "bakepoints() needs the name of a file");
    return 0;
  }
  PointCloud fresh;
  append_grid(
      fresh, {static_cast<size_t>(columns), static_cast<size_t>(rows), position, normal, irradiance, albedo});
  if (std::string problem = check(fresh); !problem.empty()) {
    complain(*context, fmt::format("bakepoints() to {}: {}", *file, problem));
    return 0;
  }
  BakedClouds& baked = of_frame<BakedClouds>(*context);
  std::lock_guard lock(baked.mutex);
  PointCloud& cloud = baked.clouds[*file];
  if (fresh.size() > 0 && cloud.size() > 0 && fresh.irradiance.empty() != cloud.irradiance.empty()) {
    complain(*context,
             fmt::format("bakepoints() to {} is called with irradiance here, without elsewhere: a cloud "
                         "has it at all points or at none",
                         *file));
    return 0;
  }
  append(cloud, fresh);
  return 0;
}

} // namespace subsurface_plugin
