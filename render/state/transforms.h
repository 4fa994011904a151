// The matrices of the transformation requests. All are meant for row vectors and are pre-multiplied to the
// current transformation: the request nearest the primitive acts first. Formulas: RISpec 3.2, section 4.3.
#pragma once

#include "render/state/math.h"

#include <optional>
#include <span>

namespace render {

Matrix4 translation(Vec3 by);
Matrix4 scaling(Vec3 by);
/// Degrees about an axis through the origin; the identity when the axis has no length.
Matrix4 rotation(float angle, Vec3 axis);
/// Shears along d2 so that d1 turns by `angle` degrees towards d2. Empty: an axis without length, parallel
/// axes, or an angle that reaches past d2.
std::optional<Matrix4> skew(float angle, Vec3 d1, Vec3 d2);
/// Perspective request: fov in degrees, x' = x / (z tan(fov/2)).
Matrix4 perspective_transform(float fov);
Matrix4 matrix_from(std::span<const float> sixteen);

} // namespace render
