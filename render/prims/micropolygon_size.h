// How large the micropolygons of a primitive are: ShadingRate, and coarser ones where motion or the lens
// blurs them.
#pragma once

#include "render/prims/primitive.h"
#include "render/state/camera.h"

namespace render {

/// Side of a micropolygon in pixels. `motion`: what moves is drawn moving.
///
/// A surface that moves d pixels at least, or is seen through a circle of confusion of d pixels at least, has
/// its shading rate multiplied by factor * d / 16, if that is 2 or more, rounded down to a power of two:
/// neighbouring patches then mostly agree, and where they agree their seams are closed. The factors are those
/// of GeometricApproximation.
float micropolygon_side(const Primitive& primitive, const Camera& camera, bool motion);

} // namespace render
