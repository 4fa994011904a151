// Bilinear and bicubic patches. Control points come u fastest; bicubic ones in any basis and are kept as
// Bezier points. Formulas: RISpec 3.2, section 5.3.
#pragma once

#include "render/prims/geometry.h"
#include "render/state/attributes.h"

#include <array>
#include <memory>

namespace render {

/// Points at (u,v) = (0,0), (1,0), (0,1), (1,1).
class BilinearPatch final : public Geometry {
public:
  explicit BilinearPatch(const std::array<Vec3, 4>& p) : p_(p) {}
  Box bound(const UvRect& r) const override;
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;
  void find_points(const UvPoints& at, SurfaceLattice& out) const override;
  bool ruled() const override { return true; }

private:
  Vec3 point(float u, float v) const {
    return (p_[0] * (1 - u) + p_[1] * u) * (1 - v) + (p_[2] * (1 - u) + p_[3] * u) * v;
  }

  std::array<Vec3, 4> p_;
};

/// Bezier control points.
class BicubicPatch final : public Geometry {
public:
  explicit BicubicPatch(const std::array<Vec3, 16>& p, int coarsest = 4) : p_(p), coarsest_(coarsest) {}
  Box bound(const UvRect& r) const override;
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;
  void find_points(const UvPoints& at, SurfaceLattice& out) const override;
  std::array<int, 2> coarsest() const override { return {coarsest_, coarsest_}; }

private:
  std::array<Vec3, 16> p_;
  int coarsest_;
};

std::shared_ptr<const Geometry> make_bilinear(const std::array<Vec3, 4>& points);
std::shared_ptr<const Geometry> make_bicubic(const std::array<Vec3, 16>& points, int coarsest = 4);

/// Turns 16 control values of the two bases into Bezier values, in place; `stride` floats from value to
/// value.
void convert_to_bezier(const CubicBasis& u, const CubicBasis& v, float* values, size_t stride);
/// The same by the matrices that to_bezier() gives for the bases.
void convert_to_bezier(const Matrix4& u, const Matrix4& v, float* values, size_t stride);
/// From the four control values of a basis to those of the Bezier basis.
Matrix4 to_bezier(const CubicBasis& basis);

/// The four Bernstein polynomials of degree 3 at t.
std::array<float, 4> bernstein(float t);

} // namespace render
