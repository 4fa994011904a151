#include "stdlib/subsurface/dipole.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace subsurface {

Dipole::Dipole(const Medium& medium, DiffuseFresnel how) {
  const double fdr = diffuse_fresnel(medium.eta, how);
  reduced_albedo = medium.reduced_albedo();
  effective_transport = medium.effective_transport();
  z_real = medium.mean_free_path();
  z_virtual = z_real * (1 + 4.0 / 3 * boundary_mismatch(fdr));
  fdt = 1 - fdr;
}

double Dipole::source(double z, double distance) const {
  const double reach = effective_transport * distance;
  return z * (1 + reach) * std::exp(-reach) / (distance * distance * distance);
}

double Dipole::profile(double r) const {
  return reduced_albedo / (4 * std::numbers::pi) *
         (source(z_real, std::hypot(r, z_real)) + source(z_virtual, std::hypot(r, z_virtual)));
}

double Dipole::profile_between(Vec3 x_out, Vec3 x_in, Vec3 n_in) const {
  const Vec3 real = x_in - n_in * static_cast<float>(z_real);
  const Vec3 mirrored = x_in + n_in * static_cast<float>(z_virtual);
  const double dr = std::max<double>(length(x_out - real), z_real);
  const double dv = std::max<double>(length(x_out - mirrored), z_real);
  return reduced_albedo / (4 * std::numbers::pi) * (source(z_real, dr) + source(z_virtual, dv));
}

double Dipole::within(double radius) const {
  double sum = 0;
  for (double z : {z_real, z_virtual}) {
    const double d = std::hypot(radius, z);
    sum += std::exp(-effective_transport * z);
    if (std::isfinite(d)) sum -= z * std::exp(-effective_transport * d) / d;
  }
  return reduced_albedo / 2 * sum;
}

double Dipole::total() const {
  return within(std::numeric_limits<double>::infinity());
}

double exitant_radiance(double exitance, double cosine, double eta, double fdt) {
  return fresnel_transmittance(cosine, eta) / fdt * exitance / std::numbers::pi;
}

} // namespace subsurface
