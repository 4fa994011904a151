// A NuPatch as primitives: one for each pair of knot intervals, so that creases lie between grids; trimmed,
// one for each quadrilateral that is left.
#pragma once

#include "render/prims/nurbs.h"
#include "render/prims/primitive_list.h"
#include "render/prims/trim.h"
#include "render/state/declaration.h"

namespace render {

/// `vars` have the sizes of NuPatch: uniform for each pair of intervals, varying and facevarying of knots,
/// vertex of control points. Null `quads`: the surface is not trimmed.
void add_nurbs(const std::shared_ptr<const NurbsSurface>& surface, const std::vector<UvQuad>* quads,
               std::span<const TypedParam> vars, const std::shared_ptr<const PrimitiveState>& state,
               PrimitiveList& out);

} // namespace render
