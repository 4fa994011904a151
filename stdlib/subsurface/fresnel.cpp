#include "stdlib/subsurface/fresnel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace subsurface {
namespace {

/// Points and weights of Gauss-Legendre quadrature with 8 points on [-1, 1]: the positive half.
constexpr std::array<std::array<double, 2>, 4> kGauss8{{{0.1834346424956498, 0.3626837833783620},
                                                        {0.5255324099163290, 0.3137066458778873},
                                                        {0.7966664774136267, 0.2223810344533745},
                                                        {0.9602898564975363, 0.1012285362903763}}};

/// 2 int_0^1 F(mu) mu dmu for light that comes from the thin side (eta > 1, no total reflection). With mu =
/// t^4 the steep end at grazing angles is resolved.
double from_thin_side(double eta) {
  constexpr int kPanels = 64;
  double sum = 0;
  for (int i = 0; i < kPanels; ++i)
    for (auto [x, w] : kGauss8)
      for (double sign : {-1.0, 1.0}) {
        const double t = (i + 0.5 + 0.5 * sign * x) / kPanels, mu = t * t * t * t;
        sum += 0.5 * w / kPanels * 2 * mu * fresnel_reflectance(mu, eta) * 4 * t * t * t;
      }
  return sum;
}

} // namespace

double refracted_cosine(double cosine, double eta) {
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  return sine2 >= 1 ? 0 : std::sqrt(1 - std::max(sine2, 0.0));
}

double fresnel_reflectance(double cosine, double eta) {
  const double c = std::min(std::abs(cosine), 1.0);
  if ((1 - c * c) >= eta * eta) return eta == 1 && c > 0 ? 0 : 1;
  const double t = refracted_cosine(c, eta);
  if (c + t == 0) return 1;
  const double s = (c - eta * t) / (c + eta * t), p = (t - eta * c) / (t + eta * c);
  return 0.5 * (s * s + p * p);
}

double fresnel_transmittance(double cosine, double eta) {
  return 1 - fresnel_reflectance(cosine, eta);
}

Vec3 refract(Vec3 incoming, Vec3 n, double eta) {
  const double c = -static_cast<double>(dot(incoming, n));
  if ((1 - c * c) >= eta * eta) return {};
  const double along = c / eta - refracted_cosine(c, eta);
  return incoming * static_cast<float>(1 / eta) + n * static_cast<float>(along);
}

double diffuse_reflectance_fit(double eta) {
  if (eta >= 1) return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
  return -0.4399 + 0.7099 / eta - 0.3319 / (eta * eta) + 0.0636 / (eta * eta * eta);
}

double diffuse_reflectance_exact(double eta) {
  if (eta == 1) return 0;
  // What gets through is the same in both directions but for the square of the index (reciprocity).
  return eta > 1 ? 1 - (1 - from_thin_side(eta)) / (eta * eta) : from_thin_side(1 / eta);
}

double diffuse_fresnel(double eta, DiffuseFresnel how) {
  return how == DiffuseFresnel::kExact ? diffuse_reflectance_exact(eta) : diffuse_reflectance_fit(eta);
}

double boundary_mismatch(double fdr) {
  return (1 + fdr) / (1 - fdr);
}

} // namespace subsurface
