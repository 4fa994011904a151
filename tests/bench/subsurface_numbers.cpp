// The numbers by which the subsurface library is judged, computed and printed; the tests of
// tests/unit/subsurface have bounds for each. Usage: subsurface_numbers
#include "stdlib/subsurface/fresnel.h"
#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/random.h"
#include "stdlib/subsurface/sampling.h"
#include "stdlib/subsurface/scatter_map.h"
#include "tests/unit/subsurface/numeric.h"
#include "tests/unit/subsurface/photon_walk.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace subsurface;

constexpr double kTurn = 2 * std::numbers::pi;

void print_reflectances() {
  int within = 0;
  double worst = 0, integral_off = 0;
  std::string where;
  for (const MeasuredMaterial& m : measured_materials()) {
    const MediumRgb medium = medium_of(m, 0);
    for (size_t c = 0; c < 3; ++c) {
      const double off = std::abs(appearance_of(medium[c]).albedo - m.reflectance[c]);
      within += off <= 0.01;
      if (off > worst) {
        worst = off;
        where = std::string(m.name) + " " + "rgb"[c];
      }
      const Dipole dipole(medium[c]);
      if (dipole.effective_transport <= 0) continue;
      const double numeric = test::integral(
          [&](double t) { // r = t^2: even steps in r miss the middle
            const double r = t * t;
            return 2 * t * kTurn * r * dipole.profile(r);
          },
          0, std::sqrt(60 / dipole.effective_transport), 200000);
      integral_off = std::max(integral_off, std::abs(numeric - dipole.total()));
    }
  }
  std::printf("diffuse reflectances within 0.01 of the table: %d of 36, the worst %.4f (%s)\n", within, worst,
              where.c_str());
  std::printf("integral of Rd beside the closed form: off by %.2g at most\n", integral_off);
}

void print_inversion() {
  double worst = 0;
  for (double eta : {1.0, 1.3, 1.5, 2.0}) {
    const double mismatch = boundary_mismatch(diffuse_reflectance_fit(eta));
    for (int i = 0; i <= 20000; ++i) {
      const double albedo = i / 20000.0;
      worst =
          std::max(worst, std::abs(diffuse_albedo(reduced_albedo_of(albedo, mismatch), mismatch) - albedo));
    }
  }
  std::printf("alpha' of an albedo and back: off by %.2g at most\n", worst);
}

void print_distribution() {
  Random random(11);
  std::vector<size_t> radii(64), angles(64);
  for (int i = 0; i < 64000; ++i) {
    const DiffusionSample s = sample_diffusion(random.unit(), random.unit(), 0.4);
    ++radii[static_cast<size_t>(diffusion_cdf(0.4 * s.radius) * 63.999999)];
    ++angles[static_cast<size_t>((std::atan2(s.y, s.x) / std::numbers::pi + 1) * 31.999999)];
  }
  std::printf("places of diffusion, chi-square of 64 bins: radii %.1f, angles %.1f (limit at 0.001: %.1f)\n",
              test::chi_square_uniform(radii), test::chi_square_uniform(angles), test::chi_square_limit(64));
}

void print_kernel() {
  std::printf("integral of the scatter maps' kernel over the plane:");
  for (float width : {0.1f, 2.5f, 40.0f})
    std::printf(" %.7f", test::integral(
                             [&](double r) {
                               return kTurn * r *
                                      static_cast<double>(scatter_transmission(static_cast<float>(r), width));
                             },
                             0, static_cast<double>(width)));
  std::printf("\n");
}

void print_walks() {
  std::printf("light that comes back, entered straight down, eta 1.3: alpha', walk (deviation), dipole\n");
  for (double alpha : {0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99}) {
    const Medium medium = medium_of_reduced(1 - alpha, alpha, 0, 1.3);
    test::WalkOptions options;
    options.photons = 200000;
    const test::WalkResult walk = test::walk_photons(medium, options);
    std::printf("  %5.2f  %.4f (%.4f)  %.4f\n", alpha, walk.reflected, walk.deviation,
                Dipole(medium).total());
  }
}

} // namespace

int main() {
  print_reflectances();
  print_inversion();
  print_distribution();
  print_kernel();
  print_walks();
}
