// Curves as ribbons: flat strips that turn towards the eye, or to the normals they are given. u runs across,
// v along the whole curve. Points as discs that face the eye.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/state/declaration.h"

#include <span>

namespace render {

/// Where the eye is, in object space: a point, or (orthographic) a direction towards it.
struct EyeInObject {
  Vec3 where;
  bool point = true;
  Vec3 from(Vec3 p) const { return point ? where - p : where; }
};

struct CurveLayout {
  bool cubic = true;
  bool periodic = false;
  CubicBasis basis = bezier_basis();

  int step() const { return cubic ? std::max(basis.step, 1) : 1; }
  int fewest() const { return cubic ? 4 : 2; }
  /// Of a curve with `points` points.
  int segments(int points) const {
    if (points < fewest()) return 0;
    return periodic ? points / step() : (points - fewest()) / step() + 1;
  }
  /// Curves with too few points have an end for each of them, two at most: that is what the formula of the
  /// RISpec gives in whole numbers.
  int varying(int points) const {
    return points < fewest() ? std::min(points, 2) : segments(points) + (periodic ? 0 : 1);
  }
};

/// Appends a primitive for each segment of each curve. Widths come from "width" or "constantwidth", else they
/// are 1; with "N" the ribbons face it. Sizes of the variables: RISpec 3.2, section 5.6.
void add_curves(const CurveLayout& layout, std::span<const int> points_of_curve, std::vector<Vec3> P,
                std::vector<TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out);

/// Appends a disc for each point; widths as above.
void add_points(std::vector<Vec3> P, std::vector<TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out);

} // namespace render
