// The innermost sum of a lookup: the dipoles of a block of sources at a place, in lanes of sources.
#pragma once

#include "stdlib/subsurface/vec3.h"

#include <cstddef>

namespace subsurface {

constexpr size_t kBlock = 16;

/// Sources, samples or groups of them: where they are, their flux and, by colour, their dipoles, see
/// Dipole::profile().
struct alignas(64) DipoleBlock {
  float position[3][kBlock], flux[3][kBlock];
  struct Lanes {
    float gain[kBlock], transport[kBlock], z_real[kBlock], z_virtual[kBlock];
  } dipole[3];
};

/// Sums by colour and lane.
struct alignas(64) DipoleSums {
  float lane[3][kBlock] = {};
  Color total() const;
};

/// For each lane and colour: sum += weight flux gain (source(z_real) + source(z_virtual)) at x. All lanes
/// have finite numbers; those that do not count have a weight of 0. `weight` is aligned like the block.
void add_dipoles(const DipoleBlock& block, Vec3 x, const float* weight, DipoleSums& sums);

/// exp(-x) for x >= 0, relative error below 2e-7; exp(-87) = 1.6e-38 beyond 87. Of kBlock numbers.
void exp_minus(const float* x, float* result);

} // namespace subsurface
