// Single scattering: light that is turned once inside the medium, along the refracted view ray (2001, 2.2, eq
// 6 and section 4; the course's 4.1.1). The surface is asked for through a function, so that any ray tracer
// or shadow map serves.
//
// Directions are unit vectors; w_out and w_in point away from the surface, to eye and light.
#pragma once

#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/random.h"

#include <functional>

namespace subsurface {

/// Distance inside the medium of a ray that was followed straight for `distance` although it refracts at the
/// surface (Snell; 2001, 4, which prints 1/n for 1/eta): distance |cos|/sqrt(1 - (1 - cos^2)/eta^2), cosine
/// between the normal where the light enters and the light's direction; its sign does not matter (the
/// course's code needs it positive).
double refracted_distance(double distance, double cosine, double eta);

/// One place on the refracted ray at which light is turned.
struct SingleScatteringPath {
  double out_distance = 0; ///< s_o', from the place to the point where light leaves
  double in_distance = 0;  ///< s_i, straight to where light enters
  double in_cosine = 1;    ///< between the normal there and the light
  double phase_cosine = 0; ///< between the refracted directions of travel, in and out
};

/// What a unit of length of the ray adds to the radiance that leaves, for a unit of radiance in a unit of
/// solid angle from the light [1/(length sr)]: sigma_s Ft(in) p exp(-s_i' sigma_t(in)) exp(-s_o'
/// sigma_t(out)), times what the solid angle shrinks to inside, dw_in' = cos/(eta^2 cos') dw_in (2001, eq 6
/// integrates over refracted directions; the course leaves this factor out). Ft of the way out is left to the
/// caller, as for diffusion. `out`: the medium where light leaves, `in`: where it enters (textures).
double single_scattering_density(const Medium& out, const Medium& in, const SingleScatteringPath& path);

/// What a straight ray from inside meets: where light enters.
struct SurfaceHit {
  double distance = 0;
  Vec3 normal;                       ///< unit, outward
  const MediumRgb* medium = nullptr; ///< there, or null: the same as where light leaves
};
/// Traces from a place inside towards `direction`; false: nothing there, no light.
using TraceInside = std::function<bool(Vec3 from, Vec3 direction, SurfaceHit&)>;

struct SingleScatteringSetup {
  Vec3 position, normal; ///< where light leaves; normal: outward, unit
  Vec3 w_out, w_in;      ///< to eye and light
  int samples = 16;
  uint64_t seed = 0;
  double depth = 0; ///< samples lie between the surface and this depth along the ray; 0: no bound
};

/// Radiance towards w_out for a unit of radiance in a unit of solid angle from w_in, a factor for each
/// wavelength, without the Ft of the way out [1/sr]. Samples are stratified, with the mean of the
/// wavelengths' densities. Each contribution is divided by that density, which for one wavelength is sigma_t
/// exp(-s_o' sigma_t): 2001 and the course divide by sigma_tc instead of sigma_t, which counts the way in a
/// second time.
Color single_scattering(const MediumRgb& medium, const SingleScatteringSetup& setup,
                        const TraceInside& trace);

/// The limit for a flat surface in uniform light, as a BRDF [1/sr]: alpha Ft(in) Ft(out) p/(eta^2 (|n.w_in'|
/// + |n.w_out'|)). (2001, 2.4 has it without the eta^2, which its equation 6 brings in by the solid angle
/// inside; a photon walk agrees with the form here.)
double single_scattering_brdf(const Medium& medium, Vec3 normal, Vec3 w_in, Vec3 w_out);
/// The whole BRDF: that and Ft(in) Ft(out) Rd/pi.
double subsurface_brdf(const Medium& medium, Vec3 normal, Vec3 w_in, Vec3 w_out,
                       DiffuseFresnel how = DiffuseFresnel::kFit);

} // namespace subsurface
