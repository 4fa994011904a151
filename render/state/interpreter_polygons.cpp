// The four polygon requests: one or many faces, with or without holes. All become the same list of faces.
#include "render/prims/polygons.h"
#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <numeric>

namespace render {

/// Polygon and GeneralPolygon: the vertices are those of P, in order.
void Interpreter::polygon(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  size_t n = sizes->vertex;
  std::vector<int> loops{static_cast<int>(n)};
  if (call.id == RequestId::kGeneralPolygon) loops.assign(call.integers(0).begin(), call.integers(0).end());
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  if (n < 3) {
    error(call, fmt::format("a polygon has at least 3 vertices, found {}", n));
    return;
  }
  std::vector<int> vertices(n);
  std::iota(vertices.begin(), vertices.end(), 0);
  add_polygon({vertices, 0, 0, loops}, P, vars, primitive_state(), scene_.primitives);
}

/// PointsPolygons and PointsGeneralPolygons.
void Interpreter::points_polygons(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  bool general = call.id == RequestId::kPointsGeneralPolygons;
  int first_argument = general ? 1 : 0;
  std::span<const int> loops = call.integers(first_argument);
  std::vector<int> loops_of_face(loops.size(), 1);
  if (general) loops_of_face.assign(call.integers(0).begin(), call.integers(0).end());
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto state = primitive_state();
  std::span<const int> vertices = call.integers(first_argument + 1);
  size_t first = 0, loop = 0;
  for (size_t i = 0; i < loops_of_face.size(); ++i) {
    std::span<const int> own = loops.subspan(loop, static_cast<size_t>(loops_of_face[i]));
    auto n = static_cast<size_t>(std::accumulate(own.begin(), own.end(), 0));
    add_polygon({vertices.subspan(first, n), i, first, own}, P, vars, state, scene_.primitives);
    first += n;
    loop += own.size();
  }
}

} // namespace render
