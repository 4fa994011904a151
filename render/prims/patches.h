// Bilinear and bicubic patches. Control points come u fastest; bicubic ones in any basis and are kept as
// Bezier points. Formulas: RISpec 3.2, section 5.3.
#pragma once

#include "render/prims/geometry.h"
#include "render/state/attributes.h"

#include <array>
#include <memory>

namespace render {

/// Points at (u,v) = (0,0), (1,0), (0,1), (1,1).
std::shared_ptr<const Geometry> make_bilinear(const std::array<Vec3, 4>& points);
/// Bezier control points.
std::shared_ptr<const Geometry> make_bicubic(const std::array<Vec3, 16>& points);

/// Turns 16 control values of the two bases into Bezier values, in place; `stride` floats from value to
/// value.
void convert_to_bezier(const CubicBasis& u, const CubicBasis& v, float* values, size_t stride);

/// The four Bernstein polynomials of degree 3 at t.
std::array<float, 4> bernstein(float t);

} // namespace render
