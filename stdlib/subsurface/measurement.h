// Coefficients of a material from what one measures of it: how the light of a narrow beam comes out again by
// distance, and how much of it in all (Jensen et al. 2001, 3).
#pragma once

#include "slvm/support/result.h"
#include "stdlib/subsurface/dipole.h"

#include <span>

namespace subsurface {

/// Radiant exitance per incident flux [1/length^2] at a distance from the beam [length].
struct ProfileSample {
  double radius = 0;
  double exitance = 0;
};

struct FittedMedium {
  Medium medium;  ///< g = 0
  double off = 0; ///< root of the mean square of log(fit/measured)
};

/// The medium whose dipole fits best, in the logarithm, as a profile runs over decades. The total fixes
/// alpha', without which absorption and scattering could be traded for each other; the profile then fixes
/// sigma_t' alone. Leave out what is nearer than about 1/sigma_t', where the dipole is no model. `total`: the
/// diffuse albedo, in (0, 1]. The error says which number cannot be.
slvm::Result<FittedMedium> fit_medium(std::span<const ProfileSample> profile, double total, double eta,
                                      DiffuseFresnel how = DiffuseFresnel::kFit);

} // namespace subsurface
