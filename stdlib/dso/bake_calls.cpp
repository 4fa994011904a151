// bakepoints: a point for each micropolygon of the grids that call it, written as a cloud when the frame
// ends (the course's 4.4). bakemesh: the micropolygons themselves, as a mesh on which slpoints spreads
// points.
#include "stdlib/dso/calls.h"
#include "stdlib/dso/plugin_data.h"
#include "stdlib/subsurface/grid_points.h"
#include "stdlib/subsurface/mesh.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <mutex>

namespace subsurface_plugin {
namespace {

using namespace subsurface;

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

using Triangle = std::array<Vec3, 3>;

/// The meshes of a frame, by file.
struct BakedMeshes {
  static constexpr const char* kName = "anemone.subsurface.meshes";
  void end(RixContext& context) {
    for (auto& [file, triangles] : meshes) {
      auto key = [](const Triangle& t) {
        return std::tuple(t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z);
      };
      std::sort(triangles.begin(), triangles.end(),
                [&](const Triangle& a, const Triangle& b) { return key(a) < key(b); });
      TriangleMesh mesh;
      for (const Triangle& t : triangles) {
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
      weld(mesh);
      if (auto written = write_mesh(file, mesh); !written) complain(context, written.error());
    }
  }

  std::mutex mutex;
  std::map<std::string, std::vector<Triangle>> meshes;
};

std::vector<Vec3> values_of(const RslArg* arg, size_t points) {
  float* data = nullptr;
  int stride = 0;
  arg->GetData(&data, &stride);
  std::vector<Vec3> out(points);
  for (size_t i = 0; i < points; ++i)
    out[i] = vec3(data + i * static_cast<size_t>(stride));
  return out;
}

/// What both functions get: file, P, N.
struct GridOfCall {
  std::string file;
  size_t nu = 0, nv = 0;
  size_t piece = 1;                   ///< rows that are neighbours of each other
  std::vector<Vec3> position, normal; ///< positions that are not finite: no micropolygon has this corner
};

/// False: there is nothing to be baked.
bool grid_of_call(const RslContext& context, const RslArg* argv[], const char* function, GridOfCall& out) {
  auto* grid = static_cast<RixGrid*>(context.GetRixInterface(k_RixGrid));
  int columns = 0, rows = 0, piece_rows = 0;
  // What rays hit has no micropolygons, and is not to be baked anyway.
  if (!grid || !grid->Size(&columns, &rows, &piece_rows)) return false;
  out.nu = static_cast<size_t>(columns);
  out.nv = static_cast<size_t>(rows);
  out.piece = static_cast<size_t>(piece_rows);
  RslStringIter file(argv[1]);
  out.file = *file;
  if (out.file.empty()) {
    complain(context, fmt::format("{} needs the name of a file", function));
    return false;
  }
  unsigned int points = 0;
  const RslRunFlag* active = context.GetRunFlags(&points);
  out.position = values_of(argv[2], points);
  out.normal = values_of(argv[3], points);
  // Micropolygons with a corner that does not run the call are none.
  for (size_t i = 0; i < points; ++i)
    if (!active[i]) out.position[i].x = std::numeric_limits<float>::quiet_NaN();
  return true;
}

} // namespace

int bake_points(RslContext* context, int argc, const RslArg* argv[]) {
  GridOfCall grid;
  if (!grid_of_call(*context, argv, "bakepoints()", grid)) return 0;
  const std::vector<Vec3> albedo = values_of(argv[4], grid.position.size());
  const std::vector<Vec3> irradiance =
      argc > 5 ? values_of(argv[5], grid.position.size()) : std::vector<Vec3>();
  PointCloud fresh;
  for (size_t row = 0; row < grid.nv; row += grid.piece) {
    auto of_piece = [&](const std::vector<Vec3>& values) {
      return values.empty() ? std::span<const Vec3>()
                            : std::span(values).subspan(row * grid.nu, grid.piece * grid.nu);
    };
    append_grid(fresh, {grid.nu, grid.piece, of_piece(grid.position), of_piece(grid.normal),
                        of_piece(irradiance), of_piece(albedo)});
  }
  if (std::string problem = check(fresh); !problem.empty()) {
    complain(*context, fmt::format("bakepoints() to {}: {}", grid.file, problem));
    return 0;
  }
  BakedClouds& baked = of_frame<BakedClouds>(*context);
  std::lock_guard lock(baked.mutex);
  PointCloud& cloud = baked.clouds[grid.file];
  if (fresh.size() > 0 && cloud.size() > 0 && fresh.irradiance.empty() != cloud.irradiance.empty()) {
    complain(*context,
             fmt::format("bakepoints() to {} is called with irradiance here, without elsewhere: a cloud "
                         "has it at all points or at none",
                         grid.file));
    return 0;
  }
  append(cloud, fresh);
  return 0;
}

int bake_mesh(RslContext* context, int, const RslArg* argv[]) {
  GridOfCall grid;
  if (!grid_of_call(*context, argv, "bakemesh()", grid)) return 0;
  std::vector<Triangle> fresh;
  auto add = [&](size_t a, size_t b, size_t c) {
    const Vec3 p[] = {grid.position[a], grid.position[b], grid.position[c]};
    if (!is_finite(p[0]) || !is_finite(p[1]) || !is_finite(p[2])) return;
    const bool outward = dot(cross(p[1] - p[0], p[2] - p[0]), grid.normal[a]) >= 0;
    fresh.push_back(outward ? Triangle{p[0], p[1], p[2]} : Triangle{p[0], p[2], p[1]});
  };
  for (size_t v = 0; v + 1 < grid.nv; ++v)
    for (size_t u = 0; u + 1 < grid.nu && (v + 1) % grid.piece != 0; ++u) {
      const size_t a = v * grid.nu + u;
      add(a, a + 1, a + grid.nu + 1);
      add(a, a + grid.nu + 1, a + grid.nu);
    }
  BakedMeshes& baked = of_frame<BakedMeshes>(*context);
  std::lock_guard lock(baked.mutex);
  std::vector<Triangle>& all = baked.meshes[grid.file];
  all.insert(all.end(), fresh.begin(), fresh.end());
  return 0;
}

} // namespace subsurface_plugin
