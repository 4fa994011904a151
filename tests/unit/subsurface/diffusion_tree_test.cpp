// Sums over the tree against sums over all samples, and against what a plane must give.
#include "stdlib/subsurface/diffusion_tree.h"
#include "stdlib/subsurface/dipole_block.h"
#include "stdlib/subsurface/parallel.h"
#include "tests/unit/subsurface/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>

namespace subsurface::test {
namespace {

const DipoleRgb kMarble = dipole_of(medium_of(*find_material("marble")));

/// In double, sample by sample.
Color brute_force(const PointCloud& cloud, const DipoleRgb& dipoles, Vec3 x) {
  double sum[3] = {};
  for (size_t i = 0; i < cloud.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const Dipole& d = dipoles[static_cast<size_t>(c)];
      sum[c] += d.fdt * d.profile(static_cast<double>(length(x - cloud.position[i]))) *
                static_cast<double>(cloud.irradiance[i][c] * cloud.area[i]);
    }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

/// RMS and greatest of the relative errors of all channels, and the number of terms that a lookup summed.
struct Accuracy {
  double rms = 0, worst = 0, terms = 0;
};
Accuracy accuracy(const DiffusionTree& tree, float epsilon, std::span<const Vec3> x,
                  std::span<const Color> exact) {
  const DiffusionMaterial material(kMarble);
  Accuracy a;
  LookupCount count;
  std::vector<Color> sums(x.size());
  tree.exitance(material, x, {epsilon, {}}, sums, &count);
  const auto lookups = static_cast<double>(x.size());
  for (size_t k = 0; k < x.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double off = static_cast<double>(sums[k][c] / exact[k][c]) - 1;
      a.rms += off * off / (3 * lookups);
      a.worst = std::max(a.worst, std::abs(off));
    }
  a.rms = std::sqrt(a.rms);
  a.terms = static_cast<double>(count.groups + count.samples) / lookups;
  return a;
}

/// Points of a cloud, and what a lookup there should give.
struct Probes {
  std::vector<Vec3> x;
  std::vector<Color> exact;
};
Probes probes(const PointCloud& cloud, size_t count) {
  Probes p;
  for (size_t k = 0; k < count; ++k) {
    p.x.push_back(cloud.position[k * cloud.size() / count]);
    p.exact.push_back(brute_force(cloud, kMarble, p.x.back()));
  }
  return p;
}

TEST(DipoleBlock, ExpIsAccurate) {
  float x[kBlock], result[kBlock];
  for (float first = 0; first < 86; first += 0.137f) {
    for (size_t i = 0; i < kBlock; ++i)
      x[i] = first + 0.0137f * static_cast<float>(i);
    exp_minus(x, result);
    for (size_t i = 0; i < kBlock; ++i)
      ASSERT_NEAR(static_cast<double>(result[i]) / std::exp(-static_cast<double>(x[i])), 1, 2e-7) << x[i];
  }
  x[0] = 1000, x[1] = HUGE_VALF;
  exp_minus(x, result);
  EXPECT_LT(result[0], 1e-37f);
  EXPECT_LT(result[1], 1e-37f);
}

// Places that are looked up together go through the tree together: what each of them gets does not depend on
// the company.
TEST(DiffusionTree, PlacesLookedUpTogetherGetWhatTheyGetAlone) {
  const PointCloud cloud = ball(4000, 8);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const DiffusionMaterial material(kMarble);
  std::vector<Vec3> x = probes(cloud, 37).x; // two rounds and a rest
  x.push_back({0, 0, 30});                   // far from all others
  for (int way = 0; way < 4; ++way) {
    LookupOptions options;
    options.epsilon = 0.2f;
    if (way == 1) options.smooth = true;
    if (way == 2) options.shell = {2, 9, 0.2f};
    std::vector<Vec3> normals;
    if (way == 3) {
      options.follow_topology = 1;
      for (Vec3 p : x)
        normals.push_back(normalize(p));
      options.normals = normals;
    }
    std::vector<Color> together(x.size());
    LookupCount count, alone_count;
    tree->exitance(material, x, options, together, &count);
    for (size_t i = 0; i < x.size(); ++i) {
      Color alone;
      if (way == 3) options.normals = std::span(normals).subspan(i, 1);
      tree->exitance(material, std::span(x).subspan(i, 1), options, std::span(&alone, 1), &alone_count);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(together[i][c], alone[c], 2e-6f * alone[c]) << way << ' ' << i;
    }
    EXPECT_EQ(count.groups, alone_count.groups);
    EXPECT_EQ(count.samples, alone_count.samples);
  }
}

TEST(DiffusionTree, WithoutGroupsItIsTheSum) {
  const PointCloud cloud = ball(3000, 8);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const Probes p = probes(cloud, 60);
  const Accuracy a = accuracy(*tree, 0, p.x, p.exact);
  EXPECT_LT(a.worst, 1e-5);
  EXPECT_NEAR(a.terms, 1500, 10); // half of it is dark
}

TEST(DiffusionTree, ErrorFallsWithEpsilonAndCostRises) {
  // A ball 40 mm across, lit from one side; points in the dark get all their light from far.
  const PointCloud cloud = ball(40000, 20);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const Probes p = probes(cloud, 100);
  const double bounds[][3] = {
      {1, 0.3, 60}, {0.3, 0.1, 160}, {0.1, 0.03, 400}, {0.03, 0.01, 1000}, {0.01, 0.004, 2500}};
  double before = 1, terms = 0;
  for (auto [epsilon, rms, most] : bounds) {
    const Accuracy a = accuracy(*tree, static_cast<float>(epsilon), p.x, p.exact);
    EXPECT_LT(a.rms, std::min(rms, before / 2)) << epsilon;
    EXPECT_LT(a.worst, 4 * rms) << epsilon;
    EXPECT_GT(a.terms, terms) << epsilon;
    EXPECT_LT(a.terms, most) << epsilon;
    before = a.rms;
    terms = a.terms;
  }
}

TEST(DiffusionTree, CostGrowsSlowlyWithTheNumberOfSamples) {
  // Four times the samples, about as many more terms each time: a logarithm.
  double terms[4] = {};
  for (size_t k = 0; k < 4; ++k) {
    PointCloud cloud = ball(size_t{2000} << (2 * k), 20);
    cloud.irradiance.assign(cloud.size(), {1, 1, 1});
    const auto tree = DiffusionTree::build(cloud);
    ASSERT_TRUE(tree);
    LookupCount count;
    std::vector<Color> sums(100);
    tree->exitance(DiffusionMaterial(kMarble), std::span(cloud.position).first(100), {0.1f, {}}, sums,
                   &count);
    terms[k] = static_cast<double>(count.groups + count.samples) / 100;
  }
  EXPECT_LT(terms[3], 3 * terms[0]); // 64 times the samples
  EXPECT_LT(terms[3] - terms[2], 1.5 * (terms[1] - terms[0]) + 30);
}

TEST(DiffusionTree, UniformLightGivesTheDiffuseAlbedo) {
  // A plate far wider than light spreads, with samples closer than a mean free path: Fdt times Rd.
  const MediumRgb medium = medium_of({0.8f, 0.5f, 0.2f}, {2, 1.5f, 1}, 0, 1.3);
  const DipoleRgb dipoles = dipole_of(medium);
  const auto tree = DiffusionTree::build(plate(400, 60, {1, 2, 0.5f}));
  ASSERT_TRUE(tree);
  const Color m = tree->exitance(DiffusionMaterial(dipoles), {0.02f, 0.03f, 0}, {0.02f, {}});
  EXPECT_NEAR(static_cast<double>(m.x), dipoles[0].fdt * dipoles[0].total(), 0.005);
  EXPECT_NEAR(static_cast<double>(m.y), 2 * dipoles[1].fdt * dipoles[1].total(), 0.005);
  EXPECT_NEAR(static_cast<double>(m.z), 0.5 * dipoles[2].fdt * dipoles[2].total(), 0.005);
}

TEST(DiffusionTree, GroupsAreSums) {
  const PointCloud cloud = ball(2000, 5);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  double area = 0, flux = 0, z = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    const double f = static_cast<double>(cloud.irradiance[i].x * cloud.area[i]);
    area += static_cast<double>(cloud.area[i]);
    flux += f;
    z += f * static_cast<double>(cloud.position[i].z);
  }
  const DiffusionTree::Group& root = tree->groups()[0];
  EXPECT_NEAR(static_cast<double>(root.area) / area, 1, 1e-5);
  EXPECT_NEAR(static_cast<double>(root.flux.x) / flux, 1, 1e-5);
  EXPECT_NEAR(static_cast<double>(root.position.z), z / flux, 1e-4);
  EXPECT_FALSE(root.dark);
}

TEST(DiffusionTree, NewLightOnTheSamePoints) {
  PointCloud cloud = ball(2000, 5);
  auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  for (size_t i = 0; i < cloud.size(); ++i)
    cloud.irradiance[i] = {cloud.position[i].x > 0 ? 1.0f : 0.0f, 0.1f, 0.7f};
  tree->set_irradiance(cloud.irradiance);
  const auto fresh = DiffusionTree::build(cloud);
  const DiffusionMaterial material(kMarble);
  for (Vec3 x : {Vec3{5, 0, 0}, Vec3{-5, 0, 0}, Vec3{0, 3, 4}})
    EXPECT_EQ(tree->exitance(material, x), fresh->exitance(material, x));
}

TEST(DiffusionTree, ColoursOfTheSamplesChooseTheDipole) {
  PointCloud cloud = ball(2000, 10);
  cloud.albedo.assign(cloud.size(), {0.8f, 0.5f, 0.2f});
  const Color path{3, 2, 1};
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const DiffusionMaterial textured(*tree, path, 1.3),
      plain(dipole_of(medium_of({0.8f, 0.5f, 0.2f}, path, 0, 1.3)));
  const Vec3 x = cloud.position[300];
  for (float epsilon : {0.0f, 0.1f})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(tree->exitance(textured, x, {epsilon, {}})[c] / tree->exitance(plain, x, {epsilon, {}})[c],
                  1, 1e-5);
  // With two colours, against the sum of the two halves.
  for (size_t i = 0; i < cloud.size(); i += 2)
    cloud.albedo[i] = {0.3f, 0.3f, 0.9f};
  const auto mixed = DiffusionTree::build(cloud);
  Color wanted;
  for (int half = 0; half < 2; ++half) {
    PointCloud part = cloud;
    for (size_t i = 0; i < cloud.size(); ++i)
      if (i % 2 != static_cast<size_t>(half)) part.irradiance[i] = {};
    const Color albedo = half == 0 ? Color{0.3f, 0.3f, 0.9f} : Color{0.8f, 0.5f, 0.2f};
    wanted += brute_force(part, dipole_of(medium_of(albedo, path, 0, 1.3)), x);
  }
  const DiffusionMaterial two(*mixed, path, 1.3);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mixed->exitance(two, x, {0, {}})[c] / wanted[c], 1, 1e-4);
    EXPECT_NEAR(mixed->exitance(two, x, {0.03f, {}})[c] / wanted[c], 1, 0.02);
  }
}

TEST(DiffusionTree, SameResultInAnyNumberOfThreads) {
  const PointCloud cloud = ball(5000, 10);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const DiffusionMaterial material(kMarble);
  // A lookup of 50 places, as a grid has them, is one thread's.
  auto looked_up = [&](unsigned threads) {
    std::vector<Color> out(cloud.size());
    const std::span<const Vec3> places = cloud.position;
    parallel_ranges(cloud.size() / 50, threads, [&](size_t begin, size_t end) {
      for (size_t grid = begin; grid < end; ++grid)
        tree->exitance(material, places.subspan(50 * grid, 50), {}, std::span(out).subspan(50 * grid, 50));
    });
    return out;
  };
  EXPECT_EQ(looked_up(1), looked_up(8));
}

TEST(DiffusionTree, OnlyWhatIsInTheShell) {
  const PointCloud cloud = ball(3000, 8);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const DiffusionMaterial material(kMarble);
  const Vec3 x{1, 2, 7.5f};
  PointCloud near = cloud;
  for (size_t i = 0; i < cloud.size(); ++i)
    if (length(x - cloud.position[i]) >= 4) near.irradiance[i] = {};
  const Color wanted = brute_force(near, kMarble, x);
  const Color all = brute_force(cloud, kMarble, x);
  const Color inside = tree->exitance(material, x, {0, {0, 4, 0}});
  const Color outside = tree->exitance(material, x, {0, {4, HUGE_VALF, 0}});
  const Color faded =
      tree->exitance(material, x, {0, {0, 4, 0.3f}}) + tree->exitance(material, x, {0, {4, HUGE_VALF, 0.3f}});
  const Color grouped = tree->exitance(material, x, {0.05f, {4, HUGE_VALF, 0.2f}});
  const Color single = tree->exitance(material, x, {0, {4, HUGE_VALF, 0.2f}});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(inside[c] / wanted[c], 1, 1e-4);
    EXPECT_NEAR((inside + outside)[c] / all[c], 1, 1e-4);
    EXPECT_NEAR(faded[c] / all[c], 1, 1e-4);
    EXPECT_NEAR(grouped[c] / single[c], 1, 0.02);
  }
}

// Across the surface in small steps: how far the sum is from straight between neighbouring steps.
double roughest_step(const DiffusionTree& tree, const LookupOptions& options) {
  const DiffusionMaterial material(kMarble);
  std::vector<Vec3> x;
  for (int i = 0; i < 3000; ++i) {
    const float angle = 0.3f + 0.0002f * static_cast<float>(i);
    x.push_back(Vec3{std::sin(angle), 0, std::cos(angle)} * 20);
  }
  std::vector<Color> sums(x.size());
  tree.exitance(material, x, options, sums);
  double worst = 0;
  for (size_t i = 1; i + 1 < sums.size(); ++i)
    worst = std::max(
        worst, static_cast<double>(std::abs(sums[i - 1].y - 2 * sums[i].y + sums[i + 1].y) / sums[i].y));
  return worst;
}

TEST(DiffusionTree, SmoothLookupsHaveNoEdges) {
  const PointCloud cloud = ball(40000, 20);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  LookupOptions options;
  options.epsilon = 0.5f;
  const double edges = roughest_step(*tree, options);
  options.smooth = true;
  const double smooth = roughest_step(*tree, options);
  EXPECT_GT(edges, 1e-3);
  EXPECT_LT(smooth, edges / 10);
  // And no worse beside the sum.
  const Probes p = probes(cloud, 60);
  const DiffusionMaterial material(kMarble);
  double off[2] = {};
  for (int with : {0, 1}) {
    options.smooth = with;
    for (size_t k = 0; k < p.x.size(); ++k)
      off[with] +=
          std::abs(static_cast<double>(tree->exitance(material, p.x[k], options).y / p.exact[k].y) - 1);
  }
  EXPECT_LT(off[1], off[0]);
}

// Two plates that face each other, as lips do: one is lit, and no light crosses the air to the other.
TEST(DiffusionTree, FollowingTheTopologyKeepsLightOutOfTheAir) {
  PointCloud cloud = plate(60, 30, {1, 1, 1}), lower = plate(60, 30, {});
  for (size_t i = 0; i < cloud.size(); ++i) {
    cloud.position[i].z = 0.1f;
    cloud.normal[i] = {0, 0, -1};
    lower.normal[i] = {0, 0, 1};
  }
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree && tree->has_normals());
  const DiffusionMaterial material(kMarble);
  const Vec3 x{1, 2, 0}, up[] = {{0, 0, 1}}, down[] = {{0, 0, -1}};
  LookupOptions plain, follow, half, own;
  follow.normals = half.normals = up;
  own.normals = down;
  follow.follow_topology = own.follow_topology = 1;
  half.follow_topology = 0.5f;
  const Color free = tree->exitance(material, x, plain);
  EXPECT_GT(free.x, 0.1f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(tree->exitance(material, x, follow)[c], 0, 1e-6f);
    EXPECT_NEAR(tree->exitance(material, x, half)[c], free[c] / 2, 1e-5f);
    EXPECT_NEAR(tree->exitance(material, x, own)[c], free[c], 1e-5f); // the same side: nothing is lost
  }
}

TEST(DiffusionTree, FollowingTheTopologyAgreesBetweenGroupsAndSamples) {
  const PointCloud cloud = ball(20000, 20);
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const DiffusionMaterial material(kMarble);
  for (size_t i = 0; i < cloud.size(); i += 700) {
    const Vec3 n[] = {normalize(cloud.normal[i] + Vec3{0.5f, 0, -1})};
    LookupOptions exact, grouped;
    exact.normals = grouped.normals = n;
    exact.follow_topology = grouped.follow_topology = 0.8f;
    exact.epsilon = 0;
    grouped.epsilon = 0.02f;
    const Color a = tree->exitance(material, cloud.position[i], exact),
                b = tree->exitance(material, cloud.position[i], grouped);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(b[c] / a[c], 1, 0.03) << i;
  }
}

TEST(DiffusionTree, SaysWhatIsMissing) {
  PointCloud cloud = ball(10, 1);
  cloud.irradiance.clear();
  EXPECT_EQ(DiffusionTree::build(cloud).error(), "the cloud has no irradiance: light it first");
  cloud.area.clear();
  EXPECT_EQ(DiffusionTree::build(cloud).error(), "the cloud has no areas");
  const auto empty = DiffusionTree::build({});
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->exitance(DiffusionMaterial(kMarble), {1, 2, 3}), Color{});
}

TEST(DiffusionTree, HostileNumbersStayFinite) {
  PointCloud cloud;
  for (float s : {0.0f, 1e-30f, 1.0f, 1e19f, 3e38f}) {
    cloud.position.push_back({s, -s, s});
    cloud.area.push_back(1);
    cloud.irradiance.push_back({1, 1, 1});
  }
  const auto tree = DiffusionTree::build(cloud);
  ASSERT_TRUE(tree);
  const MediumRgb nothing{}; // empty space
  for (const DipoleRgb& dipoles : {kMarble, dipole_of(nothing)})
    for (Vec3 x : {Vec3{}, Vec3{1, -1, 1}, Vec3{1e19f, 0, 0}})
      EXPECT_TRUE(is_finite(tree->exitance(DiffusionMaterial(dipoles), x)));
  EXPECT_EQ(tree->exitance(DiffusionMaterial(dipole_of(nothing)), {}), Color{});
}

} // namespace
} // namespace subsurface::test
