#include "stdlib/subsurface/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace subsurface {

double diffusion_cdf(double u) {
  // 1 - exp(-u)(1 + u) loses its digits near 0.
  if (u < 1e-3) return u * u * (0.5 - u * (1.0 / 3 - u / 8));
  return 1 - std::exp(-u) * (1 + u);
}

double diffusion_radius(double xi) {
  if (!(xi > 0)) return 0;
  xi = std::min(xi, 1 - 0x1p-53);
  // Newton on the logarithm of the tail, -log(1 - xi) = u - log(1 + u): nearly a parabola at first, then
  // nearly a line; it is convex, so that from its right every step comes down towards the root.
  const double target = -std::log1p(-xi);
  double u = target + std::sqrt(2 * target) + 1e-300;
  for (int i = 0; i < 60; ++i) {
    const double off = u - std::log1p(u) - target;
    const double next = u - off * (1 + u) / u;
    if (!(next > 0) || std::abs(next - u) <= 1e-14 * u) break;
    u = next;
  }
  return u;
}

double diffusion_pdf(double r, double effective_transport) {
  return effective_transport * effective_transport * std::exp(-effective_transport * r) /
         (2 * std::numbers::pi);
}

DiffusionSample sample_diffusion(double xi_radius, double xi_angle, double effective_transport) {
  const double r = diffusion_radius(xi_radius) / effective_transport, angle = 2 * std::numbers::pi * xi_angle;
  return {r * std::cos(angle), r * std::sin(angle), r};
}

double diffusion_weight(const Dipole& dipole, double r, double effective_transport) {
  const double pdf = diffusion_pdf(r, effective_transport);
  return pdf > 0 ? dipole.profile(r) / pdf : 0;
}

double single_scattering_distance(double xi, double sigma_t) {
  return -std::log1p(-xi) / sigma_t;
}

double single_scattering_distance(double xi, double choice, std::span<const double> sigma_t) {
  const auto count = static_cast<double>(sigma_t.size());
  const auto index = std::min(static_cast<size_t>(choice * count), sigma_t.size() - 1);
  return single_scattering_distance(xi, sigma_t[index]);
}

double single_scattering_pdf(double s, std::span<const double> sigma_t) {
  double sum = 0;
  for (double sigma : sigma_t)
    sum += sigma * std::exp(-sigma * s);
  return sum / static_cast<double>(sigma_t.size());
}

} // namespace subsurface
