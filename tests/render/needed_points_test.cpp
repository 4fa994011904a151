// Points that nothing shows are not shaded, and pictures do not change for it.
#include "render/statistics.h"
#include "tests/render/renderer_fixture.h"

#include <gmock/gmock.h>

namespace render::testing {
namespace {

constexpr const char* kScene =
    "Projection \"perspective\" \"fov\" 40 Translate 0 0 6 WorldBegin "
    "LightSource \"ambientlight\" 1 LightSource \"distantlight\" 2 \"from\" [1 1 -1] ";

class NeededPointsTest : public RendererTest {
protected:
  void SetUp() override {
    RendererTest::SetUp();
    size_ = 32;
    settings_.statistics = [this](const FrameStatistics& s) { shaded_ = s.report.shaded_points; };
    shaders_["matte"] = kMatte;
    shaders_["ambientlight"] = "light ambientlight(float intensity = .2) { L = 0; Cl = intensity; }";
    shaders_["distantlight"] =
        "light distantlight(point from = 0, to = (0,0,0)) { solar(to - from, 0) Cl = 1; }";
  }

  /// The picture with all points shaded and without, which must be the same; how many points each took.
  std::pair<size_t, size_t> compare(const std::string& world, const std::string& mode = "rgba") {
    EXPECT_EQ(render(kScene + ("Attribute \"cull\" \"hidden\" 0 " + world) + " WorldEnd", mode), "");
    const size_t all = shaded_;
    const std::vector<float> expected = pixels_;
    EXPECT_GT(std::count_if(expected.begin(), expected.end(), [](float v) { return v > 0; }), 60) << world;
    EXPECT_EQ(render(kScene + world + " WorldEnd", mode), "");
    EXPECT_EQ(pixels_, expected) << world;
    return {all, shaded_};
  }

  size_t shaded_ = 0;
};

/// Many squares smaller than pixels, in two rows of the mesh, each with a colour of its own at each corner.
std::string small_faces(const std::string& more) {
  constexpr int kSide = 60;
  std::string counts, corners, points, colours;
  for (int j = 0; j <= kSide; ++j)
    for (int i = 0; i <= kSide; ++i) {
      points += fmt::format("{} {} {} ", i * .05 - 1.5, j * .05 - 1.5, .02 * (i * 7 % 5));
      colours += fmt::format("{} {} .5 ", i * 3 % 4 * .25, j * 5 % 3 * .4);
    }
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const int a = j * (kSide + 1) + i;
      counts += "4 ";
      corners += fmt::format("{} {} {} {} ", a, a + 1, a + kSide + 2, a + kSide + 1);
    }
  return fmt::format("PointsPolygons [{}] [{}] \"P\" [{}] \"varying color Cs\" [{}] {}", counts, corners,
                     points, colours, more);
}

TEST_F(NeededPointsTest, faces_smaller_than_pixels_are_shaded_where_samples_are) {
  head_ += "PixelSamples 2 1\n";
  const auto [all, needed] = compare("Surface \"matte\" " + small_faces(""));
  EXPECT_LT(needed, all / 3);
  // Smooth ones are shaded at all their corners.
  const auto [smooth_all, smooth] =
      compare("ShadingInterpolation \"smooth\" Surface \"matte\" " + small_faces(""));
  EXPECT_EQ(smooth_all, all);
  EXPECT_GT(smooth, needed);
  EXPECT_LT(smooth, smooth_all);
}

TEST_F(NeededPointsTest, far_sides_and_hair) {
  const auto [all, needed] =
      compare("Surface \"matte\" ShadingRate .1 Sides 1 Rotate 40 1 1 0 Torus 1.2 .5 0 360 360");
  EXPECT_LT(needed, all * 3 / 4);
  std::string hair = "Surface \"matte\" Curves \"linear\" [";
  std::string points;
  for (int i = 0; i < 200; ++i) {
    hair += "2 ";
    points += fmt::format("{} -1 0 {} 1 .5 ", i * .015 - 1.5, i * 7 % 50 * .06 - 1.5);
  }
  const auto [all_hair, needed_hair] =
      compare(hair + "] \"nonperiodic\" \"P\" [" + points + "] \"constantwidth\" [.03]");
  EXPECT_LE(needed_hair, all_hair / 2);
}

TEST_F(NeededPointsTest, variables_of_all_kinds_come_along) {
  shaders_["show"] =
      "surface show(uniform string word = \"\"; uniform float n[2] = {0, 0}; "
      "varying vector v = 0; float f = 0; output varying color shown = 0) "
      "{ if (word == \"red\") Ci = color(n[0], v[1], f); shown = color(1 + u, s, 2 + xcomp(P)); }";
  const std::string variables = "\"uniform string word\" [\"red\"] \"constant float[2] n\" [.5 .25] "
                                "\"constant vector v\" [0 .75 0] \"varying float f\" [0 .3 .6 .9]";
  const std::string patches =
      "Surface \"show\" Scale .3 .3 1 Patch \"bilinear\" \"P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] " + variables +
      " Translate 2 1 0 Patch \"bilinear\" \"P\" [-1 -1 0 1 -1 0 -1 1 0 2 3 2] " + variables;
  for (const char* mode : {"rgba", "shown"}) {
    const auto [all, needed] = compare(patches, mode);
    EXPECT_LT(needed, all);
  }
}

TEST_F(NeededPointsTest, shaders_that_look_at_more_than_a_point_run_at_all) {
  shaders_["slope"] = "surface slope() { Ci = abs(Du(s)) + Cs; }";
  shaders_["says"] = "surface says() { Ci = Cs; printf(\"%f\", s); }";
  shaders_["moves"] = "surface moves() { P += vector(.2, .1, 0); Ci = Cs; }";
  shaders_["sees"] = "surface sees() { Ci = Cs + trace(P, N); }";
  shaders_["texturelight"] = "light texturelight() { solar() Cl = 1 + Du(xcomp(Ps)); }";
  shaders_["bumps"] = "displacement bumps() { P += .01 * N; }";
  shaders_["fog"] = "volume fog() { Ci += abs(Dv(xcomp(P))); }";
  for (const char* look :
       {"Surface \"slope\"", "Surface \"says\"", "Surface \"moves\"", "Surface \"sees\"",
        "LightSource \"texturelight\" 9 Surface \"matte\"", "Surface \"matte\" Displacement \"bumps\"",
        "Surface \"matte\" Atmosphere \"fog\""}) {
    const auto [all, needed] = compare(std::string(look) + " Attribute \"cull\" \"backfacing\" 0 Sides 1 " +
                                       "Rotate 40 1 1 0 Torus 1.2 .5 0 360 360");
    EXPECT_EQ(needed, all) << look;
  }
}

TEST_F(NeededPointsTest, single_micropolygons_take_their_neighbours_along) {
  shaders_["slope"] = "surface slope() { vector d = Du(P); color c = Dv(Cs); Ci = color(abs(xcomp(d)), "
                      "abs(comp(c, 0)), abs(Du(abs(zcomp(P))))); }";
  shaders_["mirror"] = "surface mirror() { Ci = trace(P, reflect(normalize(I), normalize(N))) + .5 * Cs; }";
  shaders_["texturelight"] = "light texturelight() { solar((0,0,1), 0) Cl = 1 + abs(Du(xcomp(Ps))); }";
  head_ += "PixelSamples 2 1\n";
  for (const char* look :
       {"Surface \"slope\" ", "Surface \"mirror\" ", "LightSource \"texturelight\" 9 Surface \"matte\" "}) {
    const auto [all, needed] = compare("Attribute \"visibility\" \"trace\" 1 " + (look + small_faces("")));
    EXPECT_LT(needed, all / 3) << look;
    // What is blended has all four corners, and differences at each.
    const std::string smooth = "ShadingInterpolation \"smooth\" ";
    compare(smooth + look + small_faces(""));
  }
}

TEST_F(NeededPointsTest, small_things_are_shaded_for_what_their_shaders_say) {
  shaders_["says"] = "surface says() { printf(\"said\\n\"); }";
  // No sample is at the corner of a pixel.
  head_ += "PixelSamples 1 1\nHider \"hidden\" \"jitter\" 0\n";
  for (const char* point :
       {"Points \"P\" [0 0 0] \"constantwidth\" .001", "Scale .001 .001 1 Sphere 1 -1 1 360"}) {
    printed_.clear();
    EXPECT_EQ(render(std::string(kScene) + "Surface \"says\" " + point + " WorldEnd"), "");
    EXPECT_THAT(printed_, ::testing::HasSubstr("said")) << point;
    render(std::string(kScene) + "Surface \"matte\" " + point + " WorldEnd");
    EXPECT_EQ(shaded_, 0u) << point;
  }
}

TEST_F(NeededPointsTest, random_numbers_stay_those_of_the_grid) {
  shaders_["noisy"] = "surface noisy() { Ci = random(); }";
  const auto [all, needed] = compare("Surface \"noisy\" ShadingRate .2 Disk 0 1 360");
  EXPECT_EQ(needed, all);
}

TEST_F(NeededPointsTest, a_lens_or_motion_may_show_any) {
  const std::string ball = "Surface \"matte\" Sides 1 Sphere 1 -1 1 360";
  head_ += "Shutter 0 1\n";
  compare("MotionBegin [0 1] Translate 0 0 0 Translate .5 0 0 MotionEnd " + ball);
  head_ += "DepthOfField 4 1 5\n";
  compare(ball);
}

} // namespace
} // namespace render::testing
