// The innermost sum of a lookup: the dipoles of a block of sources at known distances, a form that compilers
// turn into vector instructions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace subsurface {

constexpr size_t kBlock = 16;

/// One colour of a block: for each lane sum += flux gain (source(z_real) + source(z_virtual)), see
/// Dipole::profile().
struct DipoleLanes {
  float gain[kBlock], transport[kBlock], z_real[kBlock], z_virtual[kBlock];
};
void add_dipoles(const float* distance2, const float* flux, const DipoleLanes& lanes, float* sum);
/// The same with one dipole for all lanes.
void add_dipoles(const float* distance2, const float* flux, float gain, float transport, float z_real,
                 float z_virtual, float* sum);

/// exp(-x) for x >= 0, relative error below 2e-7; exp(-87) = 1.6e-38 beyond 87.
float exp_minus(float x);

} // namespace subsurface
