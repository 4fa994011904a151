// Ground truth: photons that walk through a half-space, event by event, until they leave or are absorbed.
// Slow, and right where the dipole is an approximation.
#pragma once

#include "stdlib/subsurface/medium.h"

#include <cstdint>
#include <vector>

namespace subsurface::test {

struct WalkOptions {
  size_t photons = 100000;
  uint64_t seed = 1;
  std::vector<double>
      radii; ///< rising bounds of the rings in which leaving light is counted, the first from 0
};

/// Shares of the light that has entered, straight down, at one point. It meets the boundary from inside with
/// Fresnel's reflectance.
struct WalkResult {
  double reflected = 0;      ///< all that leaves again
  double single = 0;         ///< that of it which was scattered once
  std::vector<double> rings; ///< what leaves in each ring
  double deviation = 0;      ///< standard deviation of `reflected`
  double events = 0;         ///< scattering events of light that leaves, mean
};
WalkResult walk_photons(const Medium& medium, const WalkOptions& options);

/// Plane albedo of a half-space without Fresnel reflection and with isotropic scattering, for light at this
/// cosine: 1 - H(mu) sqrt(1 - alpha), H by iteration of Chandrasekhar's equation ("Radiative Transfer", 1960,
/// chapter V).
double exact_plane_albedo(double albedo, double mu);

} // namespace subsurface::test
