// What every surface is to the renderer: a map from (u,v) in the unit square to points of object space, with
// a bound for any part of the square. Splitting a surface is splitting its rectangle; dicing is evaluating a
// lattice of it. Read next: primitive.h, split.h, dice.h.
#pragma once

#include "render/state/math.h"

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

/// Points of a lattice, u fastest, in object space. N is along dPdu x dPdv, of any length, and never zero
/// where the surface has a tangent plane (poles and collapsed edges included).
struct SurfaceLattice {
  std::vector<Vec3> P, dPdu, dPdv, N;
  void resize(size_t points) {
    P.resize(points);
    dPdu.resize(points);
    dPdv.resize(points);
    N.resize(points);
  }
  /// Makes room for all pairs of a u and a v and calls f(k, u, v) for each, which fills in point k.
  template <class F> void fill(std::span<const float> u, std::span<const float> v, F&& f) {
    resize(u.size() * v.size());
    size_t k = 0;
    for (float vj : v)
      for (float ui : u)
        f(k++, ui, vj);
  }
};

class Geometry {
public:
  virtual ~Geometry() = default;
  /// A box around the part `rect`, in object space. May be larger, never smaller.
  virtual Box bound(const UvRect& rect) const = 0;
  /// All pairs of a u and a v, u fastest.
  virtual void evaluate(std::span<const float> u, std::span<const float> v, SurfaceLattice& out) const = 0;
  /// Whether all lines of constant u or v are straight, so that the four corners tell the size of a part.
  virtual bool ruled() const { return false; }
  /// Micropolygons the whole of u and of v takes at least, however small it is: powers of two.
  virtual std::array<int, 2> coarsest() const { return {4, 4}; }
};

} // namespace render
