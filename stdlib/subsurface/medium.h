// What a homogeneous scattering medium is made of, and the forms in which people say it: coefficients, or
// what one sees: the albedo under diffuse light and how far light spreads.
//
// Lengths are in any unit, coefficients in its inverse; the papers have mm. One wavelength at a time; see
// materials.h for three. Sources: Jensen et al., "A Practical Model for Subsurface Light Transport", 2001
// ("2001"); Jensen and Buhler, "A Rapid Hierarchical Rendering Technique for Translucent Materials", 2002
// ("2002").
#pragma once

#include "stdlib/subsurface/fresnel.h"

namespace subsurface {

/// Absorption and scattering at one wavelength.
struct Medium {
  double sigma_a = 0; ///< absorption coefficient
  double sigma_s = 0; ///< scattering coefficient, before reduction
  double g = 0;       ///< mean cosine of a scattering event, in (-1, 1)
  double eta = 1.3;   ///< index of refraction, inside over outside

  double sigma_t() const { return sigma_a + sigma_s; }
  /// Reduced scattering: sigma_s' = (1 - g) sigma_s, that of an isotropic medium which looks the same (2002,
  /// eq 4).
  double reduced_scattering() const { return (1 - g) * sigma_s; }
  /// sigma_t' = sigma_a + sigma_s'. Absorption has no reduced form (2002, 4 writes sigma_a' for sigma_a).
  double reduced_extinction() const { return sigma_a + reduced_scattering(); }
  /// alpha = sigma_s/sigma_t; 0 for empty space.
  double albedo() const { return sigma_t() > 0 ? sigma_s / sigma_t() : 0; }
  /// alpha' = sigma_s'/sigma_t'.
  double reduced_albedo() const {
    return reduced_extinction() > 0 ? reduced_scattering() / reduced_extinction() : 0;
  }
  /// sigma_tr = sqrt(3 sigma_a sigma_t'): how fast diffuse light dies away (2001, 2.1).
  double effective_transport() const;
  /// l_d = 1/sigma_tr; infinite without absorption.
  double diffuse_mean_free_path() const { return 1 / effective_transport(); }
  /// l_u = 1/sigma_t': the largest spacing of irradiance samples (2002, 3).
  double mean_free_path() const { return 1 / reduced_extinction(); }
  /// l_s = 1/sigma_t: how far unscattered light gets.
  double single_scattering_mean_free_path() const { return 1 / sigma_t(); }
};

/// l_d/l_s = 1/sqrt(3 (1 - alpha)(1 - g alpha)) (2002, eq 11).
double scattering_distance_ratio(double albedo, double g);

/// From the reduced coefficient, which is what tables give: sigma_s = sigma_s'/(1 - g).
Medium medium_of_reduced(double sigma_a, double sigma_s_reduced, double g, double eta);

/// Rd: share of uniform diffuse light that comes back by multiple scattering, Fresnel terms left out: the
/// integral of the dipole over the plane. Depends on alpha' and A (boundary_mismatch()) only: alpha'/2 (1 +
/// exp(-4/3 A sqrt(3(1-alpha')))) exp(-sqrt(3(1-alpha'))) (2001, 2.4; 2002, eq 15).
double diffuse_albedo(double reduced_albedo, double mismatch);

/// The alpha' with this diffuse albedo, to the last digits; the inverse of diffuse_albedo(). Albedos are
/// clamped to [0, 1]. Near 1 the albedo hangs on the square root of 1 - alpha', so that tables of alpha' (the
/// course's, 4.2, is off by up to 0.115) and secant steps fail; this solves for sqrt(3 (1 - alpha')), in
/// which the curve is tame, by Newton steps kept inside a bracket.
double reduced_albedo_of(double diffuse_albedo, double mismatch);

/// What an artist sets: the colour under diffuse light (a texture's colour) and the diffuse mean free path.
struct Appearance {
  double albedo = 0.5;         ///< Rd, in [0, 1]
  double mean_free_path = 1.0; ///< l_d > 0
};

/// The medium that looks so (2002, eq 15 and 16; the course's 4.2). An albedo of 1 has no absorption and
/// hence no finite l_d: it is taken as the nearest that has, alpha' = 1 - 3e-9. mean_free_path is kept above
/// 1e-9.
Medium medium_of(Appearance appearance, double g, double eta, DiffuseFresnel how = DiffuseFresnel::kFit);
/// How a medium looks.
Appearance appearance_of(const Medium& medium, DiffuseFresnel how = DiffuseFresnel::kFit);

/// The course's 4.2 with a fixed sigma_s': sigma_a = sigma_s' (1 - alpha')/alpha' from the albedo. Black
/// absorbs without end: alpha' is kept above 1e-9.
Medium medium_of_albedo(double diffuse_albedo, double sigma_s_reduced, double g, double eta,
                        DiffuseFresnel how = DiffuseFresnel::kFit);

} // namespace subsurface
