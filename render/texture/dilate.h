// Depth masks grown at their edges, so that what a blur will take in beyond them is rendered, too (Wooten,
// Translucency Tricks, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, 6.3.2).
#pragma once

#include <cstddef>
#include <vector>

namespace render {

/// Gives pixels without depth (infinite) that are at most `radius` pixels from one that has it the depth of
/// the nearest such pixel. Exact, in time that does not depend on the radius; the listing of the course does
/// about this in passes.
void dilate_depths(int width, int height, float radius, std::vector<float>& depths);

} // namespace render
