// Hemisphere samples at few points of a shading grid, interpolated to the others.
//
// Where samples are needed is decided from the edges of the grid inwards: an edge has samples at its ends
// and, as long as some of its points are too far from them, in the middle of each half; then the inside is
// halved by lines until all its points are near enough to corners. "Near" is Ward and Heckbert's measure:
// distance by the sample's mean distance to what it sees, plus the turn of the normal, at most `maxerror`; no
// distance is more than that of another end or corner plus the way there (Krivanek and others, Making
// Radiance and Irradiance Caching Practical, 2006), or that over which the value changes as much as it is.
// That measure overlooks small things in the middle of nothing; so what would be interpolated is first
// compared with a sample in its middle. Along lines values follow the gradients at both ends, between lines
// they are blended (Coons 1967). Every step depends on the line at hand only: grids that share an edge agree
// on it, and no result depends on the order of grids.
#pragma once

#include "render/rays/hemisphere_sample.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace render {

struct LatticeProblem {
  int nu = 0, nv = 0;
  std::span<const HemispherePoint> points; ///< u fastest
  const uint64_t* mask = nullptr; ///< a bit a point: points that are off need no sample, and have no place
  float max_error = 0.5f;
  float tolerance =
      0.05f; ///< by which a middle may differ from what its surroundings predict, relative to the whole
  int most_steps = 30; ///< points between two samples, at most
  std::function<HemisphereSample(const HemispherePoint&)> sample;
};

std::vector<HemisphereSample> fill_lattice(const LatticeProblem& problem);

} // namespace render
