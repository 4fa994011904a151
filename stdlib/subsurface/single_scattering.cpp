#include "stdlib/subsurface/single_scattering.h"

#include "stdlib/subsurface/phase.h"
#include "stdlib/subsurface/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace subsurface {

double refracted_distance(double distance, double cosine, double eta) {
  const double inside = refracted_cosine(cosine, eta);
  return inside > 0 ? distance * std::abs(cosine) / inside : 0;
}

double single_scattering_density(const Medium& out, const Medium& in, const SingleScatteringPath& path) {
  const double inside = refracted_cosine(path.in_cosine, in.eta);
  if (!(inside > 0)) return 0;
  const double way_in = path.in_distance * std::abs(path.in_cosine) / inside;
  const double solid_angle = std::abs(path.in_cosine) / (in.eta * in.eta * inside);
  return out.sigma_s * fresnel_transmittance(path.in_cosine, in.eta) * solid_angle *
         henyey_greenstein(path.phase_cosine, out.g) *
         std::exp(-way_in * in.sigma_t() - path.out_distance * out.sigma_t());
}

namespace {

/// Where on the ray sample i of n lies, and its density. With a bound on the depth the density is cut off
/// there and scaled up.
struct Place {
  double distance = 0, pdf = 0;
};

Place place_of(const std::array<double, 3>& sigma_t, double depth, double xi, double choice) {
  const double sigma = sigma_t[std::min(static_cast<size_t>(choice * 3), size_t{2})];
  const double reach = depth > 0 ? -std::expm1(-sigma * depth) : 1;
  Place place;
  place.distance = single_scattering_distance(xi * reach, sigma);
  for (double s : sigma_t)
    place.pdf += s * std::exp(-s * place.distance) / (depth > 0 ? -std::expm1(-s * depth) : 1) / 3;
  return place;
}

} // namespace

Color single_scattering(const MediumRgb& medium, const SingleScatteringSetup& setup,
                        const TraceInside& trace) {
  const std::array<double, 3> sigma_t{medium[0].sigma_t(), medium[1].sigma_t(), medium[2].sigma_t()};
  const double eta = medium[1].eta;
  const Vec3 to = refract(-setup.w_out, setup.normal, eta); // into the medium
  std::array<double, 3> sum{};
  if (*std::min_element(sigma_t.begin(), sigma_t.end()) <= 0 || to == Vec3{}) return {};
  Random random(setup.seed);
  const int count = std::max(setup.samples, 1);
  const double turn = random.unit();
  for (int i = 0; i < count; ++i) {
    // Wavelengths are picked in turn by a golden-ratio sequence, distances within strata.
    const double choice = std::fmod(turn + i * 0.6180339887498949, 1.0);
    const Place place = place_of(sigma_t, setup.depth, (i + random.unit()) / count, choice);
    SurfaceHit hit;
    if (!(place.pdf > 0)) continue;
    if (!trace(setup.position + to * static_cast<float>(place.distance), setup.w_in, hit)) continue;
    const double cosine = dot(setup.w_in, hit.normal);
    if (cosine <= 0) continue; // it would enter from behind
    const Vec3 ti = refract(-setup.w_in, hit.normal, eta);
    const SingleScatteringPath path{place.distance, hit.distance, cosine, dot(ti, -to)};
    const MediumRgb& entry = hit.medium ? *hit.medium : medium;
    for (size_t c = 0; c < 3; ++c)
      sum[c] += single_scattering_density(medium[c], entry[c], path) / place.pdf / count;
  }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

namespace {

double both_transmittances(const Medium& medium, Vec3 normal, Vec3 w_in, Vec3 w_out) {
  return fresnel_transmittance(dot(normal, w_in), medium.eta) *
         fresnel_transmittance(dot(normal, w_out), medium.eta);
}

} // namespace

double single_scattering_brdf(const Medium& medium, Vec3 normal, Vec3 w_in, Vec3 w_out) {
  if (dot(normal, w_in) <= 0 || dot(normal, w_out) <= 0) return 0;
  const Vec3 ti = refract(-w_in, normal, medium.eta), to = -refract(-w_out, normal, medium.eta);
  const double slant = std::abs(dot(normal, ti)) + std::abs(dot(normal, to));
  if (!(slant > 0)) return 0;
  return medium.albedo() * both_transmittances(medium, normal, w_in, w_out) *
         henyey_greenstein(dot(ti, to), medium.g) / (medium.eta * medium.eta * slant);
}

double subsurface_brdf(const Medium& medium, Vec3 normal, Vec3 w_in, Vec3 w_out, DiffuseFresnel how) {
  if (dot(normal, w_in) <= 0 || dot(normal, w_out) <= 0) return 0;
  return single_scattering_brdf(medium, normal, w_in, w_out) +
         both_transmittances(medium, normal, w_in, w_out) * Dipole(medium, how).total() / std::numbers::pi;
}

} // namespace subsurface
