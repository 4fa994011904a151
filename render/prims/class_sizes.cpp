// Class sizes, primitive by primitive, with the checks of the counts they follow from.
#include "render/prims/class_sizes.h"

#include "render/prims/curves.h"
#include "render/prims/patch_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace render {

namespace {

SizesOfRequest wrong(int argument, std::string text) {
  SizesOfRequest out;
  out.error = std::move(text);
  out.argument = argument;
  return out;
}

SizesOfRequest sized(size_t uniform, size_t varying, size_t vertex, size_t facevarying) {
  return {{uniform, varying, vertex, facevarying}, {}, -1};
}

/// Points of "P" or "Pw".
size_t points_given(const RequestCall& call) {
  if (const Param* p = call.find_param("P")) return p->numbers.size() / 3;
  const Param* pw = call.find_param("Pw");
  return pw ? pw->numbers.size() / 4 : 0;
}

/// Nothing, or what is wrong with argument `i`: "periodic" or "nonperiodic", which old scenes call "nowrap".
std::string check_wrap(const RequestCall& call, int i) {
  const std::string& text = call.text(i);
  if (text == "periodic" || text == "nonperiodic" || text == "nowrap") return {};
  return fmt::format("unknown wrap \"{}\"; expected \"periodic\" or \"nonperiodic\"", text);
}

/// The number of corners of all loops, each of which has at least `fewest`.
SizesOfRequest loop_corners(std::span<const int> loops, int argument, int fewest = 3) {
  size_t corners = 0;
  for (int n : loops) {
    if (n < fewest)
      return wrong(argument, fmt::format("a polygon has at least {} vertices, found {}", fewest, n));
    corners += static_cast<size_t>(n);
  }
  return sized(1, corners, corners, corners);
}

/// Faces that share vertices: their numbers are argument `i`, the counts of their loops stand before. Single
/// faces may be wrong: they are left out when the mesh is made, as are the points and edges that exporters
/// write among them.
SizesOfRequest shared_vertices(const RequestCall& call, int i, size_t faces) {
  SizesOfRequest loops = loop_corners(call.integers(i - 1), i - 1, 0);
  if (!loops.ok()) return loops;
  size_t corners = loops.sizes.facevarying;
  std::span<const int> vertices = call.integers(i);
  if (corners != vertices.size())
    return wrong(i,
                 fmt::format("'nvertices' asks for {} vertex numbers, found {}", corners, vertices.size()));
  int last = -1;
  for (int v : vertices)
    last = std::max(last, v);
  // Files often carry more points than the faces use: P decides.
  size_t points = static_cast<size_t>(last) + 1;
  if (const Param* p = call.find_param("P"); p && p->numbers.size() >= 3) points = p->numbers.size() / 3;
  return sized(faces, points, points, corners);
}

SizesOfRequest general_polygons(const RequestCall& call) {
  // 64 bits: hostile counts must not wrap round.
  int64_t sum = 0;
  for (int n : call.integers(0))
    sum += n < 1 ? int64_t{1} << 40 : n;
  if (sum != static_cast<int64_t>(call.integers(1).size()))
    return wrong(0, fmt::format("'nloops' must be positive and add up to the {} loops of 'nvertices'",
                                call.integers(1).size()));
  return shared_vertices(call, 2, call.integers(0).size());
}

/// Patch and PatchMesh.
SizesOfRequest mesh(const RequestCall& call, BasisSteps steps) {
  const std::string& type = call.text(0);
  if (type != "bicubic" && type != "bilinear")
    return wrong(0, fmt::format("unknown type \"{}\"; expected \"bilinear\" or \"bicubic\"", type));
  MeshDirection d[2];
  for (int side = 0; side < 2; ++side) {
    d[side].cubic = type == "bicubic";
    d[side].points = d[side].order();
    d[side].basis.step = side == 0 ? steps.u : steps.v;
    if (call.id != RequestId::kPatchMesh) continue;
    if (std::string bad = check_wrap(call, 2 + 2 * side); !bad.empty()) return wrong(2 + 2 * side, bad);
    d[side].periodic = call.text(2 + 2 * side) == "periodic";
    d[side].points = call.integer(1 + 2 * side);
    constexpr int kMostPoints = 1 << 20; // products stay ints
    if (d[side].points < d[side].order() || d[side].points > kMostPoints)
      return wrong(1 + 2 * side, fmt::format("{} is {}; a {} mesh has at least {}", side == 0 ? "nu" : "nv",
                                             d[side].points, type, d[side].order()));
  }
  auto size = [](int n, int m) { return static_cast<size_t>(n) * static_cast<size_t>(m); };
  size_t corners = size(d[0].corners(), d[1].corners());
  return sized(size(d[0].patches(), d[1].patches()), corners, size(d[0].points, d[1].points), corners);
}

SizesOfRequest nurbs(const RequestCall& call) {
  size_t intervals[2], points[2];
  for (int side = 0; side < 2; ++side) {
    int n = call.integer(5 * side), order = call.integer(5 * side + 1);
    if (order < 1 || n < order)
      return wrong(5 * side, fmt::format("{} points are too few for order {}", n, order));
    points[side] = static_cast<size_t>(n);
    intervals[side] = static_cast<size_t>(n - order + 1);
  }
  size_t corners = (intervals[0] + 1) * (intervals[1] + 1);
  return sized(intervals[0] * intervals[1], corners, points[0] * points[1], corners);
}

SizesOfRequest curves(const RequestCall& call, BasisSteps steps) {
  const std::string& type = call.text(0);
  if (type != "cubic" && type != "linear")
    return wrong(0, fmt::format("unknown type \"{}\"; expected \"linear\" or \"cubic\"", type));
  if (std::string bad = check_wrap(call, 2); !bad.empty()) return wrong(2, bad);
  CurveLayout layout;
  layout.cubic = type == "cubic";
  layout.periodic = call.text(2) == "periodic";
  layout.basis.step = steps.v;
  size_t points = 0, corners = 0;
  for (int n : call.integers(1)) {
    if (n < 0) return wrong(1, fmt::format("a curve has {} points", n));
    points += static_cast<size_t>(n);
    corners += static_cast<size_t>(layout.varying(n));
  }
  return sized(call.integers(1).size(), corners, points, corners);
}

} // namespace

size_t ClassSizes::of(StorageClass c) const {
  switch (c) {
  case StorageClass::kConstant: return 1;
  case StorageClass::kUniform: return uniform;
  case StorageClass::kVarying: return varying;
  case StorageClass::kVertex: return vertex;
  case StorageClass::kFaceVarying: return facevarying;
  }
  return 1;
}

SizesOfRequest class_sizes(const RequestCall& call, BasisSteps steps, std::optional<size_t> vertices) {
  using enum RequestId;
  switch (call.id) {
  case kSphere:
  case kCone:
  case kCylinder:
  case kHyperboloid:
  case kParaboloid:
  case kDisk:
  case kTorus: return {};
  case kPolygon:
  case kPoints: {
    size_t n = vertices.value_or(points_given(call));
    return sized(1, n, n, n);
  }
  case kGeneralPolygon:
    if (call.integers(0).empty()) return wrong(0, "a polygon has at least one loop of vertices");
    return loop_corners(call.integers(0), 0);
  case kPointsPolygons: return shared_vertices(call, 1, call.integers(0).size());
  case kPointsGeneralPolygons: return general_polygons(call);
  case kSubdivisionMesh: return shared_vertices(call, 2, call.integers(1).size());
  case kPatch:
  case kPatchMesh: return mesh(call, steps);
  case kNuPatch: return nurbs(call);
  case kCurves: return curves(call, steps);
  case kBlobby: {
    if (call.integer(0) < 0) return wrong(0, "the number of leaves is negative");
    auto leaves = static_cast<size_t>(call.integer(0));
    return sized(1, leaves, leaves, leaves);
  }
  case kGeometry: return sized(1, 4, 16, 4); // of each patch of the teapot
  default: return sized(1, 1, 1, 1);
  }
}

} // namespace render
