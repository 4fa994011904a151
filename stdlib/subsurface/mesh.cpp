#include "stdlib/subsurface/mesh.h"

#include "slvm/support/files.h"
#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <numeric>

namespace subsurface {

Vec3 TriangleMesh::wide_normal(size_t triangle) const {
  const Vec3 a = corner(triangle, 0);
  return cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
}

double TriangleMesh::total_area() const {
  double sum = 0;
  for (size_t t = 0; t < triangles.size(); ++t)
    sum += static_cast<double>(area(t));
  return sum;
}

void append_grid(TriangleMesh& mesh, size_t nu, size_t nv, std::span<const Vec3> points) {
  assert(points.size() >= nu * nv);
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
  for (size_t v = 0; v + 1 < nv; ++v)
    for (size_t u = 0; u + 1 < nu; ++u) {
      const auto a = static_cast<uint32_t>(first + v * nu + u), b = a + 1;
      const auto c = static_cast<uint32_t>(a + nu), d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
}

void weld(TriangleMesh& mesh) {
  std::vector<uint32_t> sorted(mesh.vertices.size()), into(mesh.vertices.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  auto less = [&](uint32_t i, uint32_t j) {
    const Vec3 a = mesh.vertices[i], b = mesh.vertices[j];
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z != b.z ? a.z < b.z : i < j;
  };
  std::sort(sorted.begin(), sorted.end(), less);
  for (size_t k = 0; k < sorted.size(); ++k) {
    const bool same = k > 0 && mesh.vertices[sorted[k]] == mesh.vertices[sorted[k - 1]];
    into[sorted[k]] = same ? into[sorted[k - 1]] : sorted[k];
  }
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle)
      corner = into[corner];
  std::vector<std::array<uint32_t, 3>> kept;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.area(t) > 0) kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
  constexpr uint32_t kUnused = ~0u;
  std::fill(into.begin(), into.end(), kUnused);
  std::vector<Vec3> used;
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle) {
      if (into[corner] == kUnused) {
        into[corner] = static_cast<uint32_t>(used.size());
        used.push_back(mesh.vertices[corner]);
      }
      corner = into[corner];
    }
  mesh.vertices = std::move(used);
}

namespace {

/// Faces as fans of triangles. Returns what is wrong.
std::string add_faces(const PlyElement& faces, TriangleMesh& mesh) {
  const PlyProperty* corners = faces.find("vertex_indices");
  if (!corners) corners = faces.find("vertex_index");
  if (!corners || !corners->is_list) return "'face' needs the list 'vertex_indices'";
  size_t begin = 0;
  for (size_t end : corners->ends) {
    for (size_t i = begin; i < end; ++i)
      if (!(corners->items[i] >= 0 && corners->items[i] < static_cast<double>(mesh.vertices.size())))
        return fmt::format("there is no vertex {}", corners->items[i]);
    auto index = [&](size_t i) { return static_cast<uint32_t>(corners->items[i]); };
    for (size_t i = begin + 2; i < end; ++i)
      mesh.triangles.push_back({index(begin), index(i - 1), index(i)});
    begin = end;
  }
  return {};
}

} // namespace

slvm::Result<TriangleMesh> parse_mesh(std::span<const std::byte> bytes, const std::string& name) {
  auto cloud = parse_point_cloud(bytes, name);
  if (!cloud) return slvm::Error{cloud.error()};
  auto file = parse_ply(bytes, name);
  if (!file) return slvm::Error{file.error()};
  TriangleMesh mesh{std::move(cloud->position), {}};
  const PlyElement* faces = file->find("face");
  if (!faces) return slvm::Error{fmt::format("{}: there is no element 'face'", name)};
  if (std::string problem = add_faces(*faces, mesh); !problem.empty())
    return slvm::Error{fmt::format("{}: {}", name, problem)};
  return mesh;
}

slvm::Result<bool> write_mesh(const std::string& path, const TriangleMesh& mesh) {
  std::string out =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment mesh of Anemone\nelement vertex {}\n"
                  "property float x\nproperty float y\nproperty float z\nelement face {}\n"
                  "property list uchar uint vertex_indices\nend_header\n",
                  mesh.vertices.size(), mesh.triangles.size());
  auto put = [&](const void* data, size_t size) { out.append(static_cast<const char*>(data), size); };
  put(mesh.vertices.data(), mesh.vertices.size() * sizeof(Vec3));
  for (const auto& triangle : mesh.triangles) {
    out.push_back(3);
    put(triangle.data(), sizeof triangle);
  }
  return slvm::write_file(path, std::as_bytes(std::span(out)));
}

slvm::Result<TriangleMesh> read_mesh(const std::string& path) {
  auto bytes = slvm::read_file(path, kMostPlyBytes);
  if (!bytes) return slvm::Error{bytes.error()};
  return parse_mesh(*bytes, path);
}

MeshTopology::MeshTopology(const TriangleMesh& mesh) : sides_(mesh.triangles.size()) {
  struct Edge {
    uint32_t low, high, triangle;
    uint8_t edge;
    bool upwards;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (uint8_t k = 0; k < 3; ++k) {
      const uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1u) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<uint32_t>(t), k, a < b});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.edge < b.edge;
  });
  for (size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a.low != b.low || a.high != b.high || a.triangle == b.triangle) continue;
    sides_[a.triangle][a.edge] = {b.triangle, b.edge, a.upwards != b.upwards};
    sides_[b.triangle][b.edge] = {a.triangle, a.edge, a.upwards != b.upwards};
    while (i + 1 < edges.size() && edges[i + 1].low == a.low && edges[i + 1].high == a.high)
      ++i; // the others of this edge
  }
}

} // namespace subsurface
