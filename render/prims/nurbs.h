// Non-uniform rational B-splines: the basis of one direction, and surfaces. Knots are scaled so that the part
// in use is [0, 1]. Formulas: Piegl and Tiller, The NURBS Book, 2.2 and 4.3.
#pragma once

#include "render/prims/primvar.h"
#include "slvm/support/result.h"

#include <glm/vec4.hpp>

#include <vector>

namespace render {

/// The non-zero basis functions at one parameter.
struct NurbsWeights {
  static constexpr int kMaxOrder = 32;
  int first = 0; ///< control point of the first one
  double w[kMaxOrder], slope[kMaxOrder];
};

class NurbsBasis {
public:
  /// The error says which argument is impossible. `name` is what it calls the direction: "u" or "v".
  static slvm::Result<NurbsBasis> make(int points, int order, std::span<const float> knots, float min,
                                       float max, std::string_view name);

  int points() const { return points_; }
  int order() const { return order_; }
  /// Knot intervals, empty ones included; interval i is from knot(i) to knot(i + 1).
  int intervals() const { return points_ - order_ + 1; }
  double knot(int i) const { return knots_[static_cast<size_t>(order_ - 1 + i)]; }
  /// The interval that holds t; of two that meet there the upper one, and never an empty one.
  int interval(double t) const;
  NurbsWeights at(double t, int interval) const;
  /// Replaces the order() control values of an interval by the Bezier ones of its part [a, b].
  void restrict(int interval, double a, double b, glm::dvec4* values, size_t stride) const;

private:
  int points_ = 0, order_ = 0;
  std::vector<double> knots_;
};

class NurbsSurface {
public:
  NurbsBasis u, v;
  std::vector<glm::dvec4> points; ///< (xw, yw, zw, w), u fastest; every w is positive

  struct Point {
    glm::dvec3 P, dPdu, dPdv;
  };
  Point at(const NurbsWeights& u, const NurbsWeights& v) const;
  /// A line of constant v: its control points, those from `first` on, and how they change with v.
  struct Curve {
    int first;
    std::vector<glm::dvec4> points, change;
    Point at(const NurbsWeights& u, int order) const;
  };
  Curve row(const NurbsWeights& v, int first, int count) const;
  /// A box around the part of the surface over a rectangle.
  Box bound(double u0, double u1, double v0, double v1) const;
};

/// A piece of a surface: what lies over a quadrilateral of its parameter square, or, so that creases stay
/// sharp, one knot interval by another.
struct NurbsPiece {
  std::shared_ptr<const NurbsSurface> surface;
  glm::dvec2 corners[4]; ///< (u,v) at the piece's own (0,0), (1,0), (0,1), (1,1); of positive area
  int uinterval = -1, vinterval = -1; ///< -1: whatever the parameters fall into

  glm::dvec2 uv(double a, double b) const {
    return (corners[0] * (1 - a) + corners[1] * a) * (1 - b) + (corners[2] * (1 - a) + corners[3] * a) * b;
  }
  NurbsWeights uweights(double u) const {
    return surface->u.at(u, uinterval < 0 ? surface->u.interval(u) : uinterval);
  }
  NurbsWeights vweights(double v) const {
    return surface->v.at(v, vinterval < 0 ? surface->v.interval(v) : vinterval);
  }
};

std::shared_ptr<const Geometry> make_nurbs(const NurbsPiece& piece);

/// A variable by the basis of the surface ("vertex"); `values` as many as control points.
std::shared_ptr<const VarSurface> make_nurbs_vertex_var(const NurbsPiece&, std::vector<float> values,
                                                        size_t width);
/// A variable with a value for each pair of knots ("varying") or, `steps`, of intervals ("uniform").
std::shared_ptr<const VarSurface> make_nurbs_corner_var(const NurbsPiece&, std::vector<float> values,
                                                        size_t width, bool steps);

} // namespace render
