// The built-in shapes a shader can be run on: where P, N and the other geometric variables of a grid come
// from. Sizes and parametrisations are those of the RenderMan Interface's quadrics (RISpec 3.2, section 5.4).
//
// Point (x, y) of an nu x nv grid has u = x/(nu-1), v = y/(nv-1), du = 1/(nu-1), dv = 1/(nv-1), s = u, t = v
// (sampled at cell centres: u = (x+0.5)/nu, du = 1/nu). A grid of one column has u = 0.5 and du = 1, the same
// for rows. N and Ng have unit length and the direction of dPdu ^ dPdv. The view is orthographic: I = (0, 0,
// 1) at every point, and E is the origin.
#pragma once

#include "slvm/support/result.h"
#include "slvm/tools/sltest/grid_data.h"
#include "slvm/tools/sltest/setup.h"

#include <span>
#include <string_view>

namespace slvm::sltest {

struct ShapeInfo {
  std::string_view name, doc;
};
std::span<const ShapeInfo> shapes();

/// The geometric variables of the shape, and for lights Ps and Ns, for imagers P in raster space. The error
/// names the shapes there are.
Result<GridData> make_shape(const GridSpec& spec, ShaderKind kind);

} // namespace slvm::sltest
