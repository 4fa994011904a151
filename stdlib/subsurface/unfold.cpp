#include "stdlib/subsurface/unfold.h"

#include <algorithm>

namespace subsurface {
namespace {

constexpr int next(int k) {
  return k == 2 ? 0 : k + 1;
}

} // namespace

MeshPlane::MeshPlane(const TriangleMesh& mesh) : mesh_(mesh), topology_(mesh) {
  shapes_.reserve(mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), side = mesh.corner(t, 1) - a, other = mesh.corner(t, 2) - a;
    const float base = length(side);
    const float along = base > 0 ? dot(other, side) / base : 0;
    shapes_.push_back({base, {along, base > 0 ? length(cross(side, other)) / base : length(other)}});
  }
}

FlatTriangle MeshPlane::own(uint32_t triangle) const {
  return {triangle, {{{0, 0}, {shapes_[triangle].base, 0}, shapes_[triangle].top}}};
}

bool MeshPlane::across(const FlatTriangle& flat, int edge, FlatTriangle& out) const {
  const MeshTopology::Side& side = topology_.across(flat.triangle, edge);
  if (side.triangle == MeshTopology::kNone) return false;
  const FlatTriangle there = own(side.triangle);
  const int k = side.edge;
  const auto at = [](int i) { return static_cast<size_t>(i); };
  const Vec2 from = there.corner[at(k)], along = there.corner[at(next(k))] - from;
  const Vec2 third = there.corner[at(next(next(k)))] - from;
  const float scale = dot(along, along);
  if (!(scale > 0)) return false;
  Vec2 begin = flat.corner[at(edge)], end = flat.corner[at(next(edge))];
  const Vec2 here = flat.corner[at(next(next(edge)))];
  if (side.reversed) std::swap(begin, end);
  const Vec2 way = end - begin;
  Vec2 outwards{-way.y, way.x};
  if (dot(outwards, here - begin) > 0) outwards = outwards * -1.0f;
  out.triangle = side.triangle;
  out.corner[at(k)] = begin;
  out.corner[at(next(k))] = end;
  out.corner[at(next(next(k)))] =
      begin + way * (dot(third, along) / scale) + outwards * (std::abs(cross(along, third)) / scale);
  return true;
}

namespace {

/// p of the plane of `from` at the same place of the plane of `to`; the triangles have the same shape,
/// perhaps mirrored.
Vec2 carry(const FlatTriangle& from, const FlatTriangle& to, Vec2 p) {
  const Vec2 u = from.corner[1] - from.corner[0], v = from.corner[2] - from.corner[0], w = p - from.corner[0];
  const float size = cross(u, v);
  if (size == 0) return to.corner[0];
  const float a = cross(w, v) / size, b = cross(u, w) / size;
  return to.corner[0] + (to.corner[1] - to.corner[0]) * a + (to.corner[2] - to.corner[0]) * b;
}

} // namespace

Vec2 MeshPlane::to_own(const FlatTriangle& flat, Vec2 p) const {
  return carry(flat, own(flat.triangle), p);
}

Vec2 MeshPlane::from_own(const FlatTriangle& flat, Vec2 p) const {
  return carry(own(flat.triangle), flat, p);
}

std::array<float, 3> MeshPlane::weights(const SurfacePoint& point) const {
  const Shape& shape = shapes_[point.triangle];
  const float size = shape.base * shape.top.y;
  if (!(size > 0)) return {1, 0, 0};
  const float b = std::clamp(cross(point.at, shape.top) / size, 0.0f, 1.0f);
  const float c = std::clamp(shape.base * point.at.y / size, 0.0f, 1 - b);
  return {1 - b - c, b, c};
}

Vec3 MeshPlane::position(const SurfacePoint& point) const {
  const auto w = weights(point);
  return mesh_.corner(point.triangle, 0) * w[0] + mesh_.corner(point.triangle, 1) * w[1] +
         mesh_.corner(point.triangle, 2) * w[2];
}

SurfacePoint MeshPlane::settle(SurfacePoint point) const {
  const auto w = weights(point);
  const Shape& shape = shapes_[point.triangle];
  point.at = Vec2{shape.base, 0} * w[1] + shape.top * w[2];
  return point;
}

SurfacePoint MeshPlane::walk(SurfacePoint from, Vec2 way) const {
  constexpr int kMostCrossings = 1000;
  FlatTriangle flat = own(from.triangle);
  Vec2 at = from.at, goal = from.at + way;
  int came_by = -1; // the edge over which the way came in
  for (int crossing = 0;; ++crossing) {
    // The first edge that the rest of the way crosses from inside.
    const bool mirrored = cross(flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0]) < 0;
    const Vec2 rest = goal - at;
    float first = 1;
    int exit = -1;
    for (int k = 0; k < 3; ++k) {
      if (k == came_by) continue;
      const Vec2 a = flat.corner[static_cast<size_t>(k)],
                 side = flat.corner[static_cast<size_t>(next(k))] - a;
      const float sign = mirrored ? -1.0f : 1.0f;
      const float to_goal = sign * cross(side, goal - a), here = sign * cross(side, at - a);
      if (to_goal >= 0) continue;
      const float t = here > 0 ? here / (here - to_goal) : 0;
      if (t < first) first = t, exit = k;
    }
    if (exit < 0) return settle({flat.triangle, to_own(flat, goal)});
    at = at + rest * first;
    FlatTriangle beyond;
    if (crossing == kMostCrossings) return settle({flat.triangle, to_own(flat, at)});
    if (across(flat, exit, beyond)) {
      came_by = topology_.across(flat.triangle, exit).edge;
      flat = beyond;
      continue;
    }
    // A border: along it goes what is left.
    const Vec2 side = flat.corner[static_cast<size_t>(next(exit))] - flat.corner[static_cast<size_t>(exit)];
    const float size = dot(side, side);
    goal = size > 0 ? at + side * (dot(goal - at, side) / size) : at;
    came_by = exit;
  }
}

} // namespace subsurface
