// The surface of an area light. PUBLIC, abstract: whoever has the geometry implements it (render/shading).
//
// A light with an emitter (InstanceOptions::emitter) stands at many points. For each point that is lit it
// runs once for each of some points of the surface, whose P, N, u, v, s, t... it reads; what lights it gets
// the mean of. Which points these are is a function of the grid, the lit point and the number of the sample
// only.
#pragma once

#include "slvm/grid.h"

#include <span>

namespace slvm {

struct Program;

class LightEmitter {
public:
  virtual ~LightEmitter() = default;

  /// Points of the surface for each point that is lit, 1 or more.
  virtual uint32_t samples() const = 0;

  /// Fills the predefined variables and primitive variables that `reader` reads, as varying ones of `grid`,
  /// at points of the surface: the one of pair (x[i], y[i]), numbers from 0 to 1, at point i. Equal areas of
  /// the square are equal areas of the surface. Called from many threads.
  virtual void place(std::span<const float> x, std::span<const float> y, const Program& reader,
                     Grid& grid) const = 0;
};

} // namespace slvm
