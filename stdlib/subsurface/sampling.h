// Importance sampling of the two terms of the BSSRDF: places on the surface for the diffusion term, places
// along the refracted ray for the single-scattering term (2001, 4; the course's 4.1.1 and 4.1.2).
#pragma once

#include "stdlib/subsurface/dipole.h"

#include <span>

namespace subsurface {

/// Share of samples within u = sigma_tr r of the centre: 1 - exp(-u)(1 + u) (the course's 4.1.2).
double diffusion_cdf(double u);
/// Its inverse, to 1e-12, for xi in [0, 1). The course's mktables.c hands the radius of points uniform on a
/// disc to its inverse where the square of it is meant.
double diffusion_radius(double xi);
/// Density of samples at distance r on the plane, a unit of area: sigma_tr^2 exp(-sigma_tr r)/(2 pi). (2001,
/// 4 gives sigma_tr exp(-sigma_tr d), which does not integrate to 1 over the plane.)
double diffusion_pdf(double r, double effective_transport);

/// A place in the tangent plane, the centre at the origin. Irradiance there times diffusion_weight(),
/// averaged over the samples, estimates the exitance at the centre (before Fdt).
struct DiffusionSample {
  double x = 0, y = 0;
  double radius = 0;
};
/// For all wavelengths at once the smallest sigma_tr is taken: the samples reach as far as the colour that
/// spreads most, and colours do not separate into grain (the course's 4.3). sigma_tr must be above 0.
DiffusionSample sample_diffusion(double xi_radius, double xi_angle, double effective_transport);
/// profile/pdf at this distance from the centre; the estimator's 2 pi is in it (the course's code lacks a
/// factor 1/2).
double diffusion_weight(const Dipole& dipole, double r, double effective_transport);

/// Distance along the refracted ray with density sigma_t exp(-sigma_t s), for xi in [0, 1). (2001, 4 prints
/// log(xi)/sigma_t, which is negative.)
double single_scattering_distance(double xi, double sigma_t);
/// The same for several wavelengths: `choice` in [0, 1) picks one of the coefficients, all with equal chance.
double single_scattering_distance(double xi, double choice, std::span<const double> sigma_t);
/// The density of that: the mean over the wavelengths, so that no weight exceeds the number of wavelengths.
double single_scattering_pdf(double s, std::span<const double> sigma_t);

} // namespace subsurface
