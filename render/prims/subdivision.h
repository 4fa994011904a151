// Subdivision surfaces by OpenSubdiv (Bfr): every face, or every quarter of one, becomes a primitive that
// evaluates the limit surface. Regular faces are bicubic patches, the same as everywhere else.
#pragma once

#include "render/prims/primitive_list.h"
#include "render/prims/subdivision_mesh.h"
#include "render/state/declaration.h"
#include "slvm/support/result.h"

#include <span>

namespace render {

/// The surfaces. Variables as for PointsPolygons; their vertex numbers are in range. The error says
/// what is wrong with the mesh.
slvm::Result<std::shared_ptr<const Pieces>>
make_subdivision(const SubdivisionMesh& mesh, std::span<const Vec3> P, std::span<const TypedParam> vars);

} // namespace render
