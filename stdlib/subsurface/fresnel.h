// Fresnel terms of a smooth boundary between two dielectrics, for unpolarised light: one direction, and the
// average over diffuse light. eta is always the index of refraction inside the material over that outside.
#pragma once

#include "stdlib/subsurface/vec3.h"

namespace subsurface {

/// Share of light that a smooth boundary reflects. `cosine`: between normal and direction on the side from
/// which the light comes (its sign does not matter); eta: index on the other side over that on this side. 1
/// when all is reflected.
double fresnel_reflectance(double cosine, double eta);
/// 1 - fresnel_reflectance(): Ft.
double fresnel_transmittance(double cosine, double eta);

/// Cosine on the other side (Snell); 0 when all is reflected.
double refracted_cosine(double cosine, double eta);
/// Direction of unit vector `incoming` (towards the surface) behind a surface with unit normal n, which
/// points against it; the zero vector when all is reflected. eta as for fresnel_reflectance(); RSL's
/// refract() takes its inverse.
Vec3 refract(Vec3 incoming, Vec3 n, double eta);

/// Fdr, the share of diffuse light from inside that the boundary throws back: the rational fit of Groenhuis
/// et al. 1983 that both of Jensen's papers use, -1.440/eta^2 + 0.710/eta + 0.668 + 0.0636 eta (2001, 2.1;
/// 2002, eq 10); for eta < 1 the one of Egan and Hilgeman 1973. Within 0.0006 of the integral for eta
/// from 1.2 to 1.6.
double diffuse_reflectance_fit(double eta);
/// The integral itself: 2 int_0^1 F(mu) mu dmu from inside, to 1e-9. (Jensen 2001, 2.1 prints it without its
/// 1/pi, which gives values above 1.)
double diffuse_reflectance_exact(double eta);

/// Which Fdr a computation uses. The published tables and pictures rest on the fit.
enum class DiffuseFresnel { kFit, kExact };
double diffuse_fresnel(double eta, DiffuseFresnel how = DiffuseFresnel::kFit);

/// A = (1 + Fdr)/(1 - Fdr), the mismatch of the boundary (Jensen 2001, 2.1). 1 for eta = 1 with the integral.
double boundary_mismatch(double fdr);

} // namespace subsurface
