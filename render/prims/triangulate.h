// Triangles for polygons of any shape: holes are joined to the outline, then ears are cut off.
#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <span>
#include <vector>

namespace render {

using Triangle = std::array<int, 3>;

/// Covers the inside of the first loop, less the others, with triangles of indices into `points`, each
/// turning the way the first loop does. `loops` holds the number of points of each loop; all follow each
/// other. Always ends: outlines that cross themselves get triangles of some kind. No new points are made.
std::vector<Triangle> triangulate(std::span<const glm::dvec2> points, std::span<const int> loops);

/// Twice the signed area of a loop.
double loop_area(std::span<const glm::dvec2> loop);

} // namespace render
