// The dipole against its integral and against the values that the papers' formulas give when they are right.
#include "stdlib/subsurface/dipole.h"
#include "tests/unit/subsurface/numeric.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace subsurface::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// 2 pi int_0^R profile r dr; r = zr sinh t resolves peak and tail.
double numeric_within(const Dipole& d, double radius) {
  auto f = [&](double t) {
    const double r = d.z_real * std::sinh(t);
    return 2 * kPi * d.profile(r) * r * d.z_real * std::cosh(t);
  };
  return integral(f, 0, std::asinh(radius / d.z_real));
}

const Medium kMedia[] = {medium_of_reduced(0.032, 0.74, 0, 1.3), medium_of_reduced(0.0041, 2.62, 0, 1.5),
                         medium_of_reduced(0.0011, 2.55, 0, 1.3), medium_of_reduced(0.97, 0.07, 0, 1.3)};

TEST(Dipole, IntegralAgreesWithTheClosedForm) {
  const double totals[] = {0.43596, 0.79098, 0.90774};
  for (size_t i = 0; i < std::size(kMedia); ++i) {
    const Dipole d(kMedia[i]);
    EXPECT_NEAR(numeric_within(d, 60 / d.effective_transport), d.total(), 1e-6);
    for (double r : {0.1, 1.0, 5.0})
      EXPECT_NEAR(numeric_within(d, r), d.within(r), 1e-7);
    EXPECT_NEAR(d.total(), diffuse_albedo(kMedia[i].reduced_albedo(), boundary_mismatch(1 - d.fdt)), 1e-12);
    if (i < std::size(totals)) {
      EXPECT_NEAR(d.total(), totals[i], 1e-4);
    }
    EXPECT_NEAR(d.within(0), 0, 1e-15);
  }
}

TEST(Dipole, WithoutAbsorptionAllComesBack) {
  const Dipole d(medium_of_reduced(0, 11.6, 0, 1.3));
  EXPECT_EQ(d.effective_transport, 0);
  EXPECT_NEAR(d.total(), 1, 1e-12);
  EXPECT_NEAR(numeric_within(d, 1000), d.within(1000), 1e-7);
}

TEST(Dipole, ProfileAsTheSecondPaperWritesIt) {
  // 2002, eq 8 and 9, with C1 and C2.
  const Dipole d(kMedia[0]);
  for (double r : {0.0, 0.3, 2.0, 20.0}) {
    const double dr = std::hypot(r, d.z_real), dv = std::hypot(r, d.z_virtual), s = d.effective_transport;
    const double c1 = d.z_real * (s + 1 / dr), c2 = d.z_virtual * (s + 1 / dv);
    const double expected = d.reduced_albedo / (4 * kPi) *
                            (c1 * std::exp(-s * dr) / (dr * dr) + c2 * std::exp(-s * dv) / (dv * dv));
    EXPECT_NEAR(d.profile(r) / expected, 1, 1e-12);
  }
  EXPECT_NEAR(d.z_virtual / d.z_real, 1 + 4.0 / 3 * 2.602064, 1e-5);
  EXPECT_NEAR(d.fdt, 1 - 0.444763, 1e-6);
}

TEST(Dipole, PlacedOnAFlatSurfaceItIsTheProfile) {
  const Dipole d(kMedia[1]);
  for (float r : {0.0f, 0.4f, 3.0f})
    EXPECT_NEAR(d.profile_between({r, 0, 0}, {0, 0, 0}, {0, 0, 1}) / d.profile(static_cast<double>(r)), 1,
                1e-5);
}

TEST(Dipole, NothingIsSingularAtSharpEdges) {
  // The way out lies exactly where the real source is.
  const Dipole d(kMedia[1]);
  const Vec3 at_source{0, 0, -static_cast<float>(d.z_real)};
  const double there = d.profile_between(at_source, {0, 0, 0}, {0, 0, 1});
  EXPECT_TRUE(std::isfinite(there));
  EXPECT_LE(there, 2 * d.profile(0)); // that of the smallest distance, with both sources
  EXPECT_NEAR(d.profile_between(at_source + Vec3{0.01f, 0, 0}, {0, 0, 0}, {0, 0, 1}) / there, 1, 1e-3);
}

TEST(Dipole, RadianceOfExitance) {
  // Ft/Fdt M/pi; Ft is 1 - 0.0170 for a perpendicular ray at eta 1.3.
  EXPECT_NEAR(exitant_radiance(2, 1, 1.3, 0.555237), 0.982987 / 0.555237 * 2 / kPi, 1e-5);
  EXPECT_NEAR(exitant_radiance(2, 0, 1.3, 0.555237), 0, 1e-12);
}

} // namespace
} // namespace subsurface::test
