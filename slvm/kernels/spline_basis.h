// The bases of spline() by name: matrix and step (RISpec 3.2, 15.1 and 5.5).
#pragma once

#include "slvm/kernels/strings.h"

namespace slvm {

struct SplineBasis {
  /// Coefficients of t^3, t^2, t and 1, a row each, as combinations of the four knots of a segment.
  float matrix[4][4];
  uint32_t step; ///< knots from one segment to the next
  bool solve = false;

  /// Whole segments that `knots` knots give.
  constexpr uint32_t segments(uint32_t knots) const { return knots < 4 ? 0 : (knots - 4) / step + 1; }
};

inline constexpr float kSixth = 1.0f / 6.0f;
inline constexpr SplineBasis kCatmullRom{{{-0.5f, 1.5f, -1.5f, 0.5f},
                                          {1.0f, -2.5f, 2.0f, -0.5f},
                                          {-0.5f, 0.0f, 0.5f, 0.0f},
                                          {0.0f, 1.0f, 0.0f, 0.0f}},
                                         1};
inline constexpr SplineBasis kBezier{{{-1.0f, 3.0f, -3.0f, 1.0f},
                                      {3.0f, -6.0f, 3.0f, 0.0f},
                                      {-3.0f, 3.0f, 0.0f, 0.0f},
                                      {1.0f, 0.0f, 0.0f, 0.0f}},
                                     3};
inline constexpr SplineBasis kBspline{{{-kSixth, 0.5f, -0.5f, kSixth},
                                       {0.5f, -1.0f, 0.5f, 0.0f},
                                       {-0.5f, 0.0f, 0.5f, 0.0f},
                                       {kSixth, 4.0f * kSixth, kSixth, 0.0f}},
                                      1};
/// Knots are point, tangent, point, tangent.
inline constexpr SplineBasis kHermite{{{2.0f, 1.0f, -2.0f, 1.0f},
                                       {-3.0f, -2.0f, 3.0f, -1.0f},
                                       {0.0f, 1.0f, 0.0f, 0.0f},
                                       {1.0f, 0.0f, 0.0f, 0.0f}},
                                      2};
/// Leaves out the first and the last knot, so that it can stand for catmull-rom.
inline constexpr SplineBasis kLinear{
    {{0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, -1.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f}},
    1};

/// By name, catmull-rom when unknown. "solve" before a name asks for the inverse.
constexpr SplineBasis spline_basis(std::string_view name) {
  constexpr std::string_view kSolve = "solve";
  bool solve = name.starts_with(kSolve);
  if (solve) name.remove_prefix(kSolve.size());
  SplineBasis basis = kCatmullRom;
  if (name == "bezier")
    basis = kBezier;
  else if (name == "bspline" || name == "b-spline")
    basis = kBspline;
  else if (name == "hermite")
    basis = kHermite;
  else if (name == "linear")
    basis = kLinear;
  basis.solve = solve;
  return basis;
}

} // namespace slvm
