// The dipole: how much of the light that enters a flat, endless half-space at one point leaves it at another,
// by multiple scattering (2001, 2.1 and eq 4; 2002, eq 8 and 9; the course's 4.1.2). See medium.h for the
// sources.
//
// Lengths are in the unit of the medium's coefficients.
#pragma once

#include "stdlib/subsurface/medium.h"

namespace subsurface {

/// One wavelength, made ready: a source below the surface, and one of opposite sign above it.
struct Dipole {
  double reduced_albedo = 0;      ///< alpha'
  double effective_transport = 0; ///< sigma_tr
  double z_real = 0;              ///< zr = 1/sigma_t', depth of the real source
  double z_virtual = 0;           ///< zv = zr (1 + 4A/3), height of the virtual source
  double fdt = 1;                 ///< 1 - Fdr: what diffuse light leaves behind on its way in

  Dipole() = default;
  explicit Dipole(const Medium& medium, DiffuseFresnel how = DiffuseFresnel::kFit);

  /// Rd: radiant exitance at distance r per incident flux [1/area]:
  /// alpha'/(4 pi) [zr (1 + sigma_tr dr) exp(-sigma_tr dr)/dr^3 + zv (1 + sigma_tr dv) exp(-sigma_tr
  /// dv)/dv^3], dr^2 = r^2 + zr^2, dv^2 = r^2 + zv^2. (2001, eq 4 prints a 1/sigma_t' too much in its second
  /// term; the course's 4.1.2 has sigma_tr^3 in place of zr and zv: neither integrates to the total.)
  ///
  /// dr is never below 1/sigma_t', so that nothing is singular, however close the points.
  double profile(double r) const;
  /// The same for a source placed 1/sigma_t' straight below the surface at x_in and one above it, seen from
  /// x_out: for curved surfaces (2001, 4). n_in: unit, outward. Both distances are kept from falling below
  /// 1/sigma_t', which takes away the singularity at sharp edges.
  double profile_between(Vec3 x_out, Vec3 x_in, Vec3 n_in) const;

  /// 2 pi int_0^R profile(r) r dr, in closed form: alpha'/2 times the sum over both sources of
  /// exp(-sigma_tr z) - z exp(-sigma_tr d(R))/d(R).
  double within(double radius) const;
  /// The same over the whole plane: diffuse_albedo().
  double total() const;

private:
  double source(double z, double distance) const;
};

/// Radiance towards a direction from the radiant exitance M by multiple scattering (2002, eq 14): Ft/Fdt
/// M/pi; cosine: between normal and direction. (The paper prints Fdr under the fraction; its text asks for 1
/// - Fdr.)
double exitant_radiance(double exitance, double cosine, double eta, double fdt);

} // namespace subsurface
