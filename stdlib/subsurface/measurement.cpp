#include "stdlib/subsurface/measurement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace subsurface {
namespace {

/// Sum of squares by log(sigma_t').
class Misfit {
public:
  Misfit(std::span<const ProfileSample> profile, double reduced_albedo, double eta, DiffuseFresnel how)
      : profile_(profile), reduced_albedo_(reduced_albedo), eta_(eta), how_(how) {}

  Medium medium(double log_extinction) const {
    const double extinction = std::exp(log_extinction);
    return medium_of_reduced(extinction * (1 - reduced_albedo_), extinction * reduced_albedo_, 0, eta_);
  }
  double operator()(double log_extinction) const {
    const Dipole dipole(medium(log_extinction), how_);
    double sum = 0;
    for (const ProfileSample& s : profile_) {
      const double off = std::log(std::max(dipole.profile(s.radius), 1e-300) / s.exitance);
      sum += off * off;
    }
    return sum;
  }

private:
  std::span<const ProfileSample> profile_;
  double reduced_albedo_, eta_;
  DiffuseFresnel how_;
};

/// Golden sections; there is one minimum between a and b.
double least_between(const Misfit& misfit, double a, double b) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double x1 = b - golden * (b - a), x2 = a + golden * (b - a), y1 = misfit(x1), y2 = misfit(x2);
  while (b - a > 1e-9) {
    if (y1 < y2) {
      b = x2, x2 = x1, y2 = y1;
      y1 = misfit(x1 = b - golden * (b - a));
    } else {
      a = x1, x1 = x2, y1 = y2;
      y2 = misfit(x2 = a + golden * (b - a));
    }
  }
  return (a + b) / 2;
}

} // namespace

slvm::Result<FittedMedium> fit_medium(std::span<const ProfileSample> profile, double total, double eta,
                                      DiffuseFresnel how) {
  if (profile.empty()) return slvm::Error{"the profile has no samples"};
  if (!(total > 0 && total <= 1))
    return slvm::Error{fmt::format("the total reflectance is {}, it must be above 0 and not above 1", total)};
  if (!(eta > 0)) return slvm::Error{fmt::format("the index of refraction is {}, it must be above 0", eta)};
  double nearest = HUGE_VAL, farthest = 0;
  for (const ProfileSample& s : profile) {
    if (!(s.radius > 0 && s.exitance > 0) || !std::isfinite(s.radius) || !std::isfinite(s.exitance))
      return slvm::Error{fmt::format(
          "a sample of the profile is {} at a distance of {}: both must be above 0", s.exitance, s.radius)};
    nearest = std::min(nearest, s.radius);
    farthest = std::max(farthest, s.radius);
  }
  const Misfit misfit(profile, reduced_albedo_of(total, boundary_mismatch(diffuse_fresnel(eta, how))), eta,
                      how);
  // Free paths from a thousandth of the nearest to a thousand times the farthest distance: the lowest of
  // many, then between its neighbours.
  constexpr int kSteps = 400;
  const double low = -std::log(1e3 * farthest), step = (std::log(1e3 / nearest) - low) / kSteps;
  int best = 0;
  double least = HUGE_VAL;
  for (int i = 0; i <= kSteps; ++i)
    if (const double y = misfit(low + i * step); y < least) least = y, best = i;
  const double found = least_between(misfit, low + (best - 1) * step, low + (best + 1) * step);
  return FittedMedium{misfit.medium(found), std::sqrt(misfit(found) / static_cast<double>(profile.size()))};
}

} // namespace subsurface
