// What every surface is to the renderer: a map from (u,v) in the unit square to points of object space, with
// a bound for any part of the square. Splitting a surface is splitting its rectangle; dicing is evaluating a
// lattice of it. Read next: primitive.h, split.h, dice.h.
#pragma once

#include "render/state/math.h"
#include "render/state/vec3_planes.h"

#include <array>
#include <span>
#include <vector>

namespace render {

/// A part of a surface's parameter square.
struct UvRect {
  float u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  float umid() const { return 0.5f * (u0 + u1); }
  float vmid() const { return 0.5f * (v0 + v1); }
};

/// Places on a surface: all pairs of a u and a v, u fastest; or, `paired`, each u with the v of its number.
struct UvPoints {
  std::span<const float> u, v;
  bool paired = false;

  size_t size() const { return paired ? u.size() : u.size() * v.size(); }
  /// f(k, u, v) for each place k, in order.
  template <class F> void for_each(F&& f) const {
    auto same = [](float x) { return x; };
    for_each(same, same, f);
  }
  /// f(k, column, row) with what column(u) and row(v) make of a place; of pairs once for each u and v.
  template <class Column, class Row, class F> void for_each(Column&& column, Row&& row, F&& f) const {
    if (paired) {
      for (size_t k = 0; k < u.size(); ++k)
        f(k, column(u[k]), row(v[k]));
      return;
    }
    std::vector<decltype(column(0.0f))> columns;
    columns.reserve(u.size());
    for (float ui : u)
      columns.push_back(column(ui));
    size_t k = 0;
    for (float vj : v) {
      const auto here = row(vj);
      for (const auto& c : columns)
        f(k++, c, here);
    }
  }
};

/// Points of a surface, in object space. N is along dPdu x dPdv, of any length, and never zero
/// where the surface has a tangent plane (poles and collapsed edges included).
struct SurfaceLattice {
  Vec3Planes P, dPdu, dPdv, N;
  void resize(size_t points) {
    P.resize(points);
    dPdu.resize(points);
    dPdv.resize(points);
    N.resize(points);
  }
  void append(const SurfaceLattice& more) {
    P.append(more.P);
    dPdu.append(more.dPdu);
    dPdv.append(more.dPdv);
    N.append(more.N);
  }
};

class Geometry {
public:
  virtual ~Geometry() = default;
  /// A box around the part `rect`, in object space. May be larger, never smaller.
  virtual Box bound(const UvRect& rect) const = 0;
  virtual void evaluate(const UvPoints& at, SurfaceLattice& out) const = 0;
  /// The same for those who want out.P only: the rest of it may be left as it was.
  virtual void find_points(const UvPoints& at, SurfaceLattice& out) const { evaluate(at, out); }
  /// Whether all lines of constant u or v are straight, so that the four corners tell the size of a part.
  virtual bool ruled() const { return false; }
  /// Micropolygons the whole of u and of v takes at least, however small it is: powers of two.
  virtual std::array<int, 2> coarsest() const { return {4, 4}; }
};

} // namespace render
