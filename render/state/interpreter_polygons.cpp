// The four polygon requests: one or many faces, with or without holes. All become the same list of faces.
#include "render/prims/polygons.h"
#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <numeric>

namespace render {

/// Polygon and GeneralPolygon: the vertices are those of P, in order.
void Interpreter::polygon(const RequestCall& call) {
  const Param* p = call.find_param("P");
  size_t n = p ? p->numbers.size() / 3 : 0;
  if (!p && (p = call.find_param("Pw"))) n = p->numbers.size() / 4;
  std::vector<int> loops{static_cast<int>(n)};
  if (call.id == RequestId::kGeneralPolygon) {
    loops.assign(call.integers(0).begin(), call.integers(0).end());
    auto corners = check_loops(call, 0, loops);
    if (!corners) return;
    n = *corners;
  }
  std::vector<TypedParam> vars = primitive_vars(call, {1, n, n, n});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  if (n < 3) {
    error(call, fmt::format("a polygon has at least 3 vertices, found {}", n));
    return;
  }
  PolygonFaces face;
  face.vertices.resize(n);
  std::iota(face.vertices.begin(), face.vertices.end(), 0);
  face.loops_of_face = {static_cast<int>(loops.size())};
  face.loops = std::move(loops);
  add_polygons(std::move(face), std::move(P), std::move(vars), primitive_state(), scene_.primitives);
}

/// The number of corners of all loops. Nothing, with a message at argument `i`: a loop is too short.
std::optional<size_t> Interpreter::check_loops(const RequestCall& call, size_t i,
                                               std::span<const int> loops) {
  size_t corners = 0;
  for (int n : loops) {
    if (n < 3) {
      error_at(call.arguments[i].where, call, fmt::format("a polygon has at least 3 vertices, found {}", n));
      return std::nullopt;
    }
    corners += static_cast<size_t>(n);
  }
  if (loops.empty()) error_at(call.arguments[i].where, call, "a polygon has at least one loop of vertices");
  return loops.empty() ? std::nullopt : std::optional(corners);
}

/// How many points vertex numbers need. Nothing, with a message: there is a negative one, or the counts in
/// front of argument `i` ask for another number of them.
std::optional<size_t> Interpreter::check_vertices(const RequestCall& call, size_t i, size_t corners) {
  std::span<const int> vertices = call.arguments[i].ints;
  if (corners != vertices.size()) {
    error_at(call.arguments[i].where, call,
             fmt::format("'nvertices' asks for {} vertex numbers, found {}", corners, vertices.size()));
    return std::nullopt;
  }
  int last = -1;
  for (int v : vertices) {
    if (v < 0) {
      error_at(call.arguments[i].where, call, fmt::format("{} is not a vertex number; these start at 0", v));
      return std::nullopt;
    }
    last = std::max(last, v);
  }
  size_t points = static_cast<size_t>(last) + 1;
  // Files often carry more points than the faces use: P decides, if it has enough.
  if (const Param* p = call.find_param("P"); p && p->numbers.size() / 3 > points)
    points = p->numbers.size() / 3;
  return points;
}

/// PointsPolygons and PointsGeneralPolygons.
void Interpreter::points_polygons(const RequestCall& call) {
  bool general = call.id == RequestId::kPointsGeneralPolygons;
  size_t first_argument = general ? 1 : 0;
  std::span<const int> loops = call.integers(static_cast<int>(first_argument));
  std::vector<int> loops_of_face(loops.size(), 1);
  if (general) {
    loops_of_face.assign(call.integers(0).begin(), call.integers(0).end());
    // 64 bits: hostile counts must not wrap round.
    int64_t sum = 0;
    for (int n : loops_of_face)
      sum += n < 1 ? int64_t{1} << 40 : n;
    if (sum != static_cast<int64_t>(loops.size())) {
      error_at(
          call.arguments[0].where, call,
          fmt::format("'nloops' must be positive and add up to the {} loops of 'nvertices'", loops.size()));
      return;
    }
  }
  auto corners = check_loops(call, first_argument, loops);
  if (!corners) return;
  auto points = check_vertices(call, first_argument + 1, *corners);
  if (!points) return;
  std::vector<TypedParam> vars = primitive_vars(call, {loops_of_face.size(), *points, *points, *corners});
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  std::span<const int> vertices = call.integers(static_cast<int>(first_argument + 1));
  PolygonFaces faces{{vertices.begin(), vertices.end()}, {loops.begin(), loops.end()}, {}};
  if (general) faces.loops_of_face = std::move(loops_of_face);
  add_polygons(std::move(faces), std::move(P), std::move(vars), primitive_state(), scene_.primitives);
}

} // namespace render
