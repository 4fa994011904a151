// mktables: the distribution of its places, and what it prints.
#include "stdlib/subsurface/sample_tables.h"
#include "stdlib/subsurface/sampling.h"
#include "tests/temp_folder.h"
#include "tests/unit/subsurface/numeric.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <numbers>

namespace subsurface::test {
namespace {

TEST(SampleTables, RadiiHaveTheDistributionAndAnglesAreEven) {
  const SampleTables t = make_sample_tables({128, 8, 10, 0});
  ASSERT_EQ(t.x.size(), 1024u);
  std::vector<size_t> shares(16), angles(16);
  double mean = 0;
  for (size_t i = 0; i < t.x.size(); ++i) {
    const double r = std::hypot(static_cast<double>(t.x[i]), static_cast<double>(t.y[i]));
    mean += r / 1024;
    ++shares[static_cast<size_t>(diffusion_cdf(r) * 16)];
    ++angles[static_cast<size_t>(
        (std::atan2(static_cast<double>(t.y[i]), static_cast<double>(t.x[i])) / std::numbers::pi + 1) *
        7.9999)];
  }
  for (size_t count : shares)
    EXPECT_EQ(count, 64u); // exactly: the radii are quantiles
  EXPECT_LT(chi_square_uniform(angles), chi_square_limit(angles.size()));
  EXPECT_NEAR(mean, 2, 0.02);
}

TEST(SampleTables, NeighboursKeepTheirDistance) {
  // Undo the warp: places of a disc, of which the best candidates are far apart.
  const SampleTables t = make_sample_tables({128, 1, 10, 0});
  double nearest = 1e30;
  std::vector<std::pair<double, double>> disc;
  for (size_t i = 0; i < 128; ++i) {
    const double r = std::hypot(static_cast<double>(t.x[i]), static_cast<double>(t.y[i]));
    const double scale = std::sqrt(diffusion_cdf(r)) / r;
    disc.emplace_back(static_cast<double>(t.x[i]) * scale, static_cast<double>(t.y[i]) * scale);
    for (size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, std::hypot(disc[i].first - disc[j].first, disc[i].second - disc[j].second));
  }
  EXPECT_GT(nearest, 0.08); // of 128 random places the nearest two are about 0.01 apart
}

TEST(SampleTables, PrintsArraysOfTheShadingLanguage) {
  SampleTables t;
  t.x = {0.5f, -1, 2, 3};
  t.y = {0, 0.25f, 1, 1e-7f};
  EXPECT_EQ(format_sample_tables(t, {2, 2, 10, 0}),
            "uniform float scattdiffdist1[4] = {\n0.500000,-1.000000,\n2.000000,3.000000\n};\n"
            "uniform float scattdiffdist2[4] = {\n0.000000,0.250000,\n1.000000,0.000000\n};\n");
}

TEST(SampleTables, ShadersCompileWithWhatTheProgramPrints) {
  const anemone::test::TempFolder folder;
  const std::string header = (folder / "scatter.h").string();
  ASSERT_EQ(std::system((std::string(MKTABLES_PROGRAM) + " -n 16 -t 2 --seed 3 -o " + header).c_str()), 0);
  folder.write("t.sl",
               "surface t() {\n#include \"scatter.h\"\n  Ci = scattdiffdist1[31] + scattdiffdist2[0];\n}\n");
  EXPECT_EQ(
      std::system((std::string(SLC_PROGRAM) + " -q -d " + folder.string() + " " + (folder / "t.sl").string())
                      .c_str()),
      0);
  EXPECT_EQ(folder.read("scatter.h"),
            format_sample_tables(make_sample_tables({16, 2, 10, 3}), {16, 2, 10, 3}));
  EXPECT_NE(std::system((std::string(MKTABLES_PROGRAM) + " -n 0 2>/dev/null").c_str()), 0);
}

} // namespace
} // namespace subsurface::test
