#include "stdlib/subsurface/medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace subsurface {
namespace {

/// sqrt(3 (1 - alpha')) = sigma_tr/sigma_t': from 0, all is scattered, to sqrt(3), all is absorbed.
double albedo_of_ratio(double s, double mismatch) {
  return 0.5 * (1 - s * s / 3) * (1 + std::exp(-4.0 / 3 * mismatch * s)) * std::exp(-s);
}

double slope_of_ratio(double s, double mismatch) {
  const double k = 4.0 / 3 * mismatch, e = std::exp(-k * s), f = 1 - s * s / 3;
  return 0.5 * std::exp(-s) * (-2 * s / 3 * (1 + e) - k * e * f - (1 + e) * f);
}

/// The ratio with this diffuse albedo: the curve falls strictly, from 1 to 0.
double ratio_of_albedo(double albedo, double mismatch) {
  if (!(albedo > 0)) return std::numbers::sqrt3;
  if (albedo >= 1) return 0;
  double low = 0, high = std::numbers::sqrt3, s = 0.5;
  for (int i = 0; i < 100; ++i) {
    const double off = albedo_of_ratio(s, mismatch) - albedo;
    (off > 0 ? low : high) = s;
    double next = s - off / slope_of_ratio(s, mismatch);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - s);
    s = next;
    if (step <= 4 * std::numeric_limits<double>::epsilon() * s) break;
  }
  return s;
}

} // namespace

double Medium::effective_transport() const {
  return std::sqrt(3 * sigma_a * reduced_extinction());
}

double scattering_distance_ratio(double albedo, double g) {
  return 1 / std::sqrt(3 * (1 - albedo) * (1 - g * albedo));
}

Medium medium_of_reduced(double sigma_a, double sigma_s_reduced, double g, double eta) {
  return {sigma_a, sigma_s_reduced / (1 - g), g, eta};
}

double diffuse_albedo(double reduced_albedo, double mismatch) {
  const double alpha = std::clamp(reduced_albedo, 0.0, 1.0), s = std::sqrt(3 * (1 - alpha));
  return 0.5 * alpha * (1 + std::exp(-4.0 / 3 * mismatch * s)) * std::exp(-s);
}

double reduced_albedo_of(double diffuse_albedo, double mismatch) {
  if (!(diffuse_albedo > 0)) return 0;
  const double s = ratio_of_albedo(diffuse_albedo, mismatch);
  return std::max(0.0, 1 - s * s / 3);
}

Medium medium_of(Appearance appearance, double g, double eta, DiffuseFresnel how) {
  const double mismatch = boundary_mismatch(diffuse_fresnel(eta, how));
  const double s = std::max(ratio_of_albedo(appearance.albedo, mismatch), 1e-4);
  const double extinction = 1 / (std::max(appearance.mean_free_path, 1e-9) * s);
  const double sigma_a = extinction * s * s / 3; // not extinction - scattering, which cancels near albedo 1
  return medium_of_reduced(sigma_a, std::max(0.0, extinction - sigma_a), g, eta);
}

Appearance appearance_of(const Medium& medium, DiffuseFresnel how) {
  const double mismatch = boundary_mismatch(diffuse_fresnel(medium.eta, how));
  return {diffuse_albedo(medium.reduced_albedo(), mismatch), medium.diffuse_mean_free_path()};
}

Medium medium_of_albedo(double diffuse_albedo, double sigma_s_reduced, double g, double eta,
                        DiffuseFresnel how) {
  const double s = ratio_of_albedo(diffuse_albedo, boundary_mismatch(diffuse_fresnel(eta, how)));
  const double reduced_albedo = std::max(1 - s * s / 3, 1e-9);
  return medium_of_reduced(sigma_s_reduced * (s * s / 3) / reduced_albedo, sigma_s_reduced, g, eta);
}

} // namespace subsurface
