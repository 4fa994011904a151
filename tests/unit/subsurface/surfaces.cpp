#include "tests/unit/subsurface/surfaces.h"

#include <cmath>
#include <numbers>

namespace subsurface::test {

PointCloud plate(size_t n, float side, Color irradiance) {
  PointCloud cloud;
  const float cell = side / static_cast<float>(n);
  for (size_t j = 0; j < n; ++j)
    for (size_t i = 0; i < n; ++i) {
      cloud.position.push_back({(static_cast<float>(i) + 0.5f) * cell - side / 2,
                                (static_cast<float>(j) + 0.5f) * cell - side / 2, 0});
      cloud.normal.push_back({0, 0, 1});
      cloud.area.push_back(cell * cell);
      cloud.irradiance.push_back(irradiance);
    }
  return cloud;
}

PointCloud ball(size_t n, float radius) {
  PointCloud cloud;
  for (size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double r = std::sqrt(1 - z * z), angle = 2.399963229728653 * static_cast<double>(i);
    const Vec3 unit{static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
                    static_cast<float>(z)};
    cloud.position.push_back(unit * radius);
    cloud.normal.push_back(unit);
    cloud.area.push_back(4 * std::numbers::pi_v<float> * radius * radius / static_cast<float>(n));
    const float light = std::max(unit.z, 0.0f);
    cloud.irradiance.push_back({light, 0.5f * light, 0.25f * light});
  }
  return cloud;
}

TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

TriangleMesh sphere(size_t n, float radius) {
  TriangleMesh mesh;
  std::vector<Vec3> points;
  for (size_t j = 0; j <= n; ++j)
    for (size_t i = 0; i <= 2 * n; ++i) {
      const double theta = std::numbers::pi * (1 - static_cast<double>(j) / static_cast<double>(n));
      const double phi = std::numbers::pi * static_cast<double>(i % (2 * n)) / static_cast<double>(n);
      const double s = j == 0 || j == n ? 0 : std::sin(theta); // poles are one point
      points.push_back(Vec3{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                            static_cast<float>(std::cos(theta))} *
                       radius);
    }
  append_grid(mesh, 2 * n + 1, n + 1, points);
  weld(mesh);
  return mesh;
}

TriangleMesh rectangle(float width, float height) {
  return {{{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

} // namespace subsurface::test
