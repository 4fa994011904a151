// subsurface(): the same as the library's lookups, in every way in which a material can be said; and what it
// says where nothing can be seen.
#include "stdlib/scattering/cloud_lookups.h"
#include "tests/temp_folder.h"
#include "tests/unit/exec/shading.h"
#include "tests/unit/subsurface/surfaces.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace subsurface::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct CloudServices : slvm::test::TableServices {
  slvm::SubsurfaceServices* subsurface() override { return there_is_one ? &lookups : nullptr; }
  CloudCache cache;
  CloudLookups lookups{cache};
  bool there_is_one = true;
};

class SubsurfaceCall : public ::testing::Test {
protected:
  void SetUp() override {
    cloud_ = ball(2000, 1.5f);
    for (Vec3 p : cloud_.position)
      cloud_.albedo.push_back({0.9f, 0.3f + 0.2f * p.x, 0.5f});
    save("lit.ply", cloud_);
    tree_ = *DiffusionTree::build(cloud_);
  }
  void save(const std::string& name, const PointCloud& cloud) {
    ASSERT_TRUE(write_point_cloud((folder_ / name).string(), cloud));
  }
  std::string named(const std::string& name) const {
    return "\"filename\", \"" + (folder_ / name).string() + "\"";
  }

  /// Ci on a row of n points from (0, 0, 1) to (1, 0, 1).
  std::vector<Color> run(const std::string& statements, int n = 4) {
    machine_ = std::make_unique<slvm::Machine>();
    auto surface = slvm::test::instantiate(*machine_, "surface s() { " + statements + " }");
    slvm::Grid grid = slvm::test::square(n, 1);
    slvm::ShadingContext context(*machine_, services_);
    if (surface) context.shade({.surface = surface.get()}, grid);
    return slvm::test::colours_of<Color>(grid);
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> out;
    for (const slvm::RuntimeMessage& m : machine_->messages())
      out.push_back(fmt::format("{}: {} ({})", m.line, m.text, m.points));
    return out;
  }
  std::vector<Color> call(const std::string& arguments, int n = 4) {
    return run("Ci = subsurface(P, N, " + named("lit.ply") + arguments + ");", n);
  }
  static Vec3 place(size_t i) { return {static_cast<float>(i) / 3, 0, 1}; }

  /// As the library says, with Fdt taken out.
  void expect(const std::vector<Color>& got, const DiffusionMaterial& material, double eta,
              const LookupOptions& options = {}) {
    EXPECT_THAT(messages(), IsEmpty());
    for (size_t i = 0; i < got.size(); ++i) {
      const Color all = tree_.exitance(material, place(i), options);
      for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(got[i][c], all[c] / static_cast<float>(1 - diffuse_fresnel(eta))) << i;
      EXPECT_GT(got[i].x, 0);
    }
  }

  PointCloud cloud_;
  DiffusionTree tree_;
  CloudServices services_;
  std::unique_ptr<slvm::Machine> machine_;
  anemone::test::TempFolder folder_;
};

TEST_F(SubsurfaceCall, OfAMeasuredMaterial) {
  const DiffusionMaterial skin(dipole_of(medium_of(*find_material("skin1"), 0, 10)));
  expect(call(R"(, "material", "skin1", "unitlength", 10)"), skin, 1.3);
  expect(call(R"(, "material", "skin1", "scale", 0.1)"), skin, 1.3);
  const MeasuredMaterial marble = *find_material("marble");
  expect(call(""), DiffusionMaterial(dipole_of(medium_of(marble))), marble.eta);
  expect(run("Ci = subsurface(P, " + named("lit.ply") + ");"),
         DiffusionMaterial(dipole_of(medium_of(marble))), marble.eta);
}

TEST_F(SubsurfaceCall, OfAlbedoAndDiffuseMeanFreePath) {
  const DiffusionMaterial wax(dipole_of(medium_of(Color{0.8f, 0.5f, 0.2f}, Color{0.3f, 0.2f, 0.1f}, 0, 1.4)));
  expect(call(R"(, "albedo", color(.8, .5, .2), "diffusemeanfreepath", color(.3, .2, .1), "ior", 1.4)"), wax,
         static_cast<double>(1.4f));
  // In millimetres, of a scene in centimetres.
  expect(call(R"(, "albedo", color(.8, .5, .2), "diffusemeanfreepath", color(3, 2, 1), "ior", 1.4,
              "unitlength", 10)"),
         wax, static_cast<double>(1.4f));
}

TEST_F(SubsurfaceCall, OfCoefficients) {
  MediumRgb medium;
  for (size_t c = 0; c < 3; ++c)
    medium[c] = medium_of_reduced(static_cast<double>(0.02f) * 10, (1.0 + static_cast<double>(c)) * 10, 0,
                                  static_cast<double>(1.5f));
  expect(call(R"(, "scattering", color(1, 2, 3), "absorption", color(.02), "ior", 1.5, "unitlength", 10)"),
         DiffusionMaterial(dipole_of(medium)), static_cast<double>(1.5f));
}

TEST_F(SubsurfaceCall, OfTheColoursOfThePoints) {
  const DiffusionMaterial painted(tree_, {0.3f, 0.2f, 0.1f}, 1.3);
  LookupOptions options;
  options.epsilon = 0.02f;
  expect(call(R"(, "diffusemeanfreepath", color(.3, .2, .1), "maxsolidangle", 0.02)"), painted,
         static_cast<double>(1.3f), options);
}

// Another material at each point, as textures make it.
TEST_F(SubsurfaceCall, OfAMaterialThatVaries) {
  const auto got =
      run("float x = xcomp(P); Ci = subsurface(P, N, " + named("lit.ply") +
          R"(, "albedo", color(.2 + .6 * x, .5, .2), "diffusemeanfreepath", color(.1 + .1 * x)); )");
  EXPECT_THAT(messages(), IsEmpty());
  for (size_t i = 0; i < got.size(); ++i) {
    const float x = place(i).x, path = 0.1f + 0.1f * x;
    const DiffusionMaterial here(
        dipole_of(medium_of(Color{0.2f + 0.6f * x, 0.5f, 0.2f}, Color{path, path, path}, 0, 1.3)));
    EXPECT_NEAR(got[i].x, tree_.exitance(here, place(i)).x / static_cast<float>(1 - diffuse_fresnel(1.3)),
                1e-5f * got[i].x);
  }
  EXPECT_GT(got[3].x, 2 * got[0].x);
}

TEST_F(SubsurfaceCall, SmoothAndFollowingTheTopology) {
  const DiffusionMaterial wax(dipole_of(medium_of(Color{0.8f, 0.5f, 0.2f}, Color{0.3f, 0.3f, 0.3f}, 0, 1.3)));
  const std::string material = R"(, "albedo", color(.8, .5, .2), "diffusemeanfreepath", color(.3))";
  LookupOptions options;
  options.smooth = true;
  expect(call(material + R"(, "smooth", 1)"), wax, 1.3, options);
  const Vec3 away[] = {{0, 0, -1}};
  LookupOptions follow;
  follow.normals = away;
  follow.follow_topology = 0.5f;
  expect(call(material + R"(, "followtopology", 0.5)"), wax, 1.3, follow); // N of the grid is (0, 0, -1)
}

// P and N are taken to the space of the points.
TEST_F(SubsurfaceCall, InASpaceOfItsOwn) {
  slvm::Matrix4 moved;
  moved(3, 0) = 2;
  moved(3, 1) = -1;
  services_.spaces["there"] = moved;
  const auto got = run("Ci = subsurface(P + vector(2, -1, 0), N, " + named("lit.ply") +
                       R"(, "coordsystem", "there", "followtopology", 0.25, "material", "skin1");)");
  const Vec3 away[] = {{0, 0, -1}};
  LookupOptions follow;
  follow.normals = away;
  follow.follow_topology = 0.25f;
  expect(got, DiffusionMaterial(dipole_of(medium_of(*find_material("skin1")))), 1.3, follow);
  services_.spaces["world"] = moved;
  expect(run("Ci = subsurface(P + vector(2, -1, 0), N, " + named("lit.ply") + R"(, "material", "skin1");)"),
         DiffusionMaterial(dipole_of(medium_of(*find_material("skin1")))), 1.3);
}

TEST_F(SubsurfaceCall, OnlyWherePointsAreOnAndOnceWhereAllIsUniform) {
  const auto got = run("Ci = 7; if (xcomp(P) > .5) Ci = subsurface(P, N, " + named("lit.ply") + ");");
  EXPECT_EQ(got[0], (Color{7, 7, 7}));
  EXPECT_EQ(got[1], (Color{7, 7, 7}));
  EXPECT_LT(got[2].x, 7);
  EXPECT_GT(got[2].x, 0);
  const auto same = run("uniform point p = point(1, 0, 1); normal n = normal(0, 0, 1); "
                        "Ci = subsurface(p, n, " +
                        named("lit.ply") + ");");
  EXPECT_THAT(same, Each(same[0]));
  for (int c = 0; c < 3; ++c) // places that are looked up together are summed in another order
    EXPECT_NEAR(same[0][c], got[3][c], 2e-6f);
}

// In even light what comes back is the albedo.
TEST_F(SubsurfaceCall, AFlatPlateInEvenLightReturnsItsAlbedo) {
  save("plate.ply", plate(300, 30, {1, 1, 1}));
  const auto got = run("Ci = subsurface(P - vector(0, 0, 1), N, " + named("plate.ply") +
                       R"(, "albedo", color(.8, .5, .2), "diffusemeanfreepath", color(2, 1, 1));)");
  for (const Color& c : got) {
    EXPECT_NEAR(c.x, 0.8f, 0.008f);
    EXPECT_NEAR(c.y, 0.5f, 0.005f);
    EXPECT_NEAR(c.z, 0.2f, 0.002f);
  }
}

TEST_F(SubsurfaceCall, TheFileIsReadOnceForAllFrames) {
  for (int frame = 0; frame < 3; ++frame) {
    CloudServices next;
    CloudLookups lookups(services_.cache);
    call("");
  }
  EXPECT_EQ(services_.cache.counts().built, 1u);
}

TEST_F(SubsurfaceCall, WhatCannotBeLookedUpIsBlackAndSaysWhy) {
  PointCloud dark = cloud_;
  dark.irradiance.clear();
  save("dark.ply", dark);
  PointCloud bare = cloud_;
  bare.albedo.clear();
  bare.normal.clear();
  save("bare.ply", bare);
  auto complaint = [&](const std::string& arguments) {
    EXPECT_THAT(run("Ci = 7;\nCi = subsurface(P, N, " + arguments + ");", 2), Each(Color{})) << arguments;
    const auto told = messages();
    EXPECT_EQ(told.size(), 1u) << arguments;
    return told.empty() ? std::string() : told[0];
  };
  const std::string lit = named("lit.ply");
  EXPECT_EQ(complaint(R"("material", "skin1")"),
            "2: subsurface: it needs a \"filename\", that of a cloud of points with light (2)");
  EXPECT_THAT(complaint(named("none.ply")), HasSubstr("2: subsurface: cannot open '"));
  EXPECT_THAT(complaint(named("none.ply")), HasSubstr("none.ply': No such file or directory (2)"));
  EXPECT_THAT(complaint(named("dark.ply")),
              HasSubstr("dark.ply: the cloud has no irradiance: light it first"));
  EXPECT_THAT(complaint(lit + R"(, "material", "skin3")"), HasSubstr("skin3"));
  EXPECT_THAT(
      complaint(lit + R"(, "material", "skin1", "albedo", color(1))"),
      HasSubstr("subsurface: the material is said in several ways: take one of \"material\", \"scattering\" "
                "with \"absorption\", \"albedo\" with \"diffusemeanfreepath\""));
  EXPECT_THAT(complaint(lit + R"(, "albedo", color(1))"),
              HasSubstr("subsurface: \"albedo\" needs \"diffusemeanfreepath\" with it"));
  EXPECT_THAT(complaint(lit + R"(, "absorption", color(1))"),
              HasSubstr("subsurface: \"absorption\" needs \"scattering\" with it"));
  EXPECT_THAT(complaint(lit + R"(, "ior", 0)"), HasSubstr("subsurface: \"ior\" is 0, it must be above 0"));
  EXPECT_THAT(complaint(lit + R"(, "unitlength", -1)"),
              HasSubstr("subsurface: \"unitlength\" is -1, it must be above 0"));
  EXPECT_THAT(complaint(lit + R"(, "scale", 0)"),
              HasSubstr("subsurface: \"scale\" is 0, it must be above 0"));
  EXPECT_THAT(complaint(lit + R"(, "maxsolidangle", -1)"),
              HasSubstr("subsurface: \"maxsolidangle\" is -1, it must be 0 or more"));
  EXPECT_THAT(complaint(lit + R"(, "albedo", color(1), "diffusemeanfreepath", color(1, 0, 1))"),
              HasSubstr("subsurface: \"diffusemeanfreepath\" must be above 0 in each colour"));
  EXPECT_THAT(complaint(lit + R"(, "diffusemeanfreepath", color(0))"),
              HasSubstr("subsurface: \"diffusemeanfreepath\" must be above 0 in each colour"));
  EXPECT_THAT(complaint(lit + R"(, "scattering", color(1), "absorption", color(-1))"),
              HasSubstr("subsurface: \"scattering\" and \"absorption\" must be 0 or more in each colour"));
  EXPECT_THAT(complaint(lit + R"(, "coordsystem", "nowhere")"),
              HasSubstr("subsurface: there is no space \"nowhere\", in which the cloud is to be"));
  EXPECT_THAT(complaint(named("bare.ply") + R"(, "diffusemeanfreepath", color(1))"),
              HasSubstr("subsurface: the points of the cloud have no albedo: the call needs \"albedo\""));
  services_.there_is_one = false;
  EXPECT_THAT(complaint(lit), HasSubstr("subsurface: there is nobody here who looks up clouds of points"));
}

TEST_F(SubsurfaceCall, WhatHasNoEffectSaysWhy) {
  PointCloud bare = cloud_;
  bare.normal.clear();
  save("bare.ply", bare);
  EXPECT_GT(run("Ci = subsurface(P, N, " + named("bare.ply") + ", \"followtopology\", 1);")[0].x, 0);
  EXPECT_THAT(messages(),
              ElementsAre("1: subsurface: \"followtopology\" has no effect: the cloud has no normals (4)"));
  EXPECT_GT(run("Ci = subsurface(P, " + named("lit.ply") + ", \"followtopology\", 1);")[0].x, 0);
  EXPECT_THAT(messages(),
              ElementsAre("1: subsurface: \"followtopology\" needs a normal: subsurface(P, N, ...) (4)"));
}

} // namespace
} // namespace subsurface::test
