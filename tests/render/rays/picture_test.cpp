// Whole pictures whose shaders shoot rays: the same with any number of threads, and right where that is
// known.
#include "tests/render/renderer_fixture.h"

#include <cmath>

namespace render {
namespace {

constexpr int kSize = 48;

class RayPicture : public testing::RendererTest {
protected:
  void SetUp() override {
    testing::RendererTest::SetUp();
    size_ = kSize;
    head_ = "Option \"limits\" \"int[2] bucketsize\" [12 12]\n";
    shaders_ = {
        {"constant", "surface constant() { Ci = Cs; Oi = Os; }"},
        {"mirror", "surface mirror() { normal n = normalize(N); Ci = color(.1) + .8 * color trace(P, "
                   "reflect(normalize(I), "
                   "n)); Oi = 1; }"},
        {"gathered", "surface gathered(float samples = 8) { color sum = 0, c = 0; gather(\"illuminance\", P, "
                     "faceforward(normalize(N), I),"
                     " PI/2, samples, \"distribution\", \"cosine\", \"surface:Ci\", c) sum += c; else sum += "
                     ".2; Ci = Cs * sum / samples; Oi = 1; }"},
        {"occluded",
         "surface occluded() { Ci = Cs * (1 - occlusion(P, faceforward(normalize(N), I), 32)); Oi = 1; }"},
        {"bleeding", "surface bleeding() { Ci = Cs * (.2 + indirectdiffuse(P, faceforward(normalize(N), I), "
                     "16)); Oi = 1; }"},
        {"lamp", "light lamp(point from = point \"world\" (-3, 5, -2)) { illuminate(from) Cl = "
                 "transmission(Ps, from); }"},
        {"matte", "surface matte() { Ci = Cs * diffuse(faceforward(normalize(N), I)); Oi = 1; }"},
        {"dents", "displacement dents() { P -= .1 * sin(20 * s) * sin(20 * t) * normalize(N); N = "
                  "calculatenormal(P); }"}};
  }
  /// kSize x kSize pixels of 4 floats.
  std::vector<float> render(const std::string& rib, int threads = 1) {
    settings_.threads = threads;
    messages_ = testing::RendererTest::render(rib);
    return pixels_;
  }
  static float at(const std::vector<float>& pixels, int x, int y, int c) {
    return pixels[static_cast<size_t>((y * kSize + x) * 4 + c)];
  }

  std::string messages_;
};

const std::string kCamera =
    "Projection \"perspective\" \"fov\" 40 Translate 0 -.6 6 Rotate -20 1 0 0 PixelSamples 2 2 Shutter 0 1 ";

TEST_F(RayPicture, the_same_with_any_number_of_threads) {
  const std::string rib =
      kCamera + "WorldBegin LightSource \"lamp\" 1 Attribute \"visibility\" \"trace\" 1 \"string "
                "transmission\" \"opaque\" "
                "Attribute \"trace\" \"int displacements\" 1 \"int samplemotion\" 1 "
                "Surface \"occluded\" Polygon \"P\" [-4 0 4 4 0 4 4 0 -2 -4 0 -2] "
                "Surface \"bleeding\" Color 1 .3 .3 Polygon \"P\" [-4 0 4 -4 4 4 4 4 4 4 0 4] "
                "TransformBegin Surface \"mirror\" Translate -1 .7 1 Sphere .7 -.7 .7 360 TransformEnd "
                "TransformBegin Surface \"gathered\" Color .4 .4 1 Translate .6 .6 0 MotionBegin [0 1] "
                "Translate 0 0 0 Translate .4 0 0 "
                "MotionEnd Sphere .6 -.6 .6 360 TransformEnd "
                "TransformBegin Attribute \"displacementbound\" \"float sphere\" .2 Displacement \"dents\" "
                "Surface \"matte\" "
                "Translate 0 .4 -1 Sphere .4 -.4 .4 360 TransformEnd WorldEnd";
  std::vector<float> one = render(rib, 1);
  EXPECT_EQ(messages_, "");
  for (int threads : {2, 4, 3, 4}) {
    std::vector<float> more = render(rib, threads);
    int different = 0;
    float most = 0;
    for (size_t i = 0; i < one.size(); ++i) {
      different += more[i] != one[i];
      most = std::max(most, std::abs(more[i] - one[i]));
    }
    EXPECT_EQ(different, 0) << threads << " threads, by up to " << most;
  }
}

TEST_F(RayPicture, objects_behind_the_camera_and_later_in_the_file_are_seen_in_mirrors) {
  // A mirror facing the eye, a red wall behind it that comes later; another one, unseen by rays, in between.
  std::vector<float> p =
      render("Projection \"perspective\" \"fov\" 40 WorldBegin Surface \"mirror\" Translate 0 0 5 "
             "Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] Surface \"constant\" Color 0 1 0 Translate 0 0 -7 "
             "Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0] Attribute \"visibility\" \"trace\" 1 "
             "Color 1 0 0 Translate 0 0 -7 Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0] WorldEnd");
  EXPECT_EQ(messages_, "");
  EXPECT_NEAR(at(p, 24, 24, 0), 0.9f, 1e-3f);
  EXPECT_NEAR(at(p, 24, 24, 1), 0.1f, 1e-3f);
}

TEST_F(RayPicture, mirrors_facing_each_other_end_at_the_depth_of_rays) {
  // Each bounce adds .1 * .8^k; after maxspeculardepth rays nothing is seen.
  for (auto [depth, value] : {std::pair(0, 0.1f), {1, 0.18f}, {3, 0.1f * (1 + .8f + .64f + .512f)}}) {
    std::vector<float> p = render(fmt::format(
        "Projection \"perspective\" \"fov\" 40 WorldBegin Attribute \"trace\" \"int maxspeculardepth\" {} "
        "Attribute \"visibility\" \"trace\" 1 Surface \"mirror\" Translate 0 0 5 Polygon \"P\" [-9 -9 0 9 -9 "
        "0 9 9 0 -9 9 0] "
        "Translate 0 0 -9 Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0] WorldEnd",
        depth));
    EXPECT_NEAR(at(p, 24, 24, 0), value, 1e-4f) << depth;
  }
}

TEST_F(RayPicture, the_camera_may_be_the_only_one_that_does_not_see) {
  std::vector<float> p = render(
      "Projection \"perspective\" \"fov\" 40 WorldBegin Surface \"mirror\" Translate 0 0 5 "
      "Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] Attribute \"visibility\" \"int camera\" 0 \"trace\" 1 "
      "Surface \"constant\" Color 1 0 0 Translate 0 0 -2 Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0] "
      "WorldEnd");
  EXPECT_NEAR(at(p, 24, 24, 0), 0.9f, 1e-3f) << "seen in the mirror only";
  EXPECT_NEAR(at(p, 24, 24, 1), 0.1f, 1e-3f);
}

TEST_F(RayPicture, procedurals_are_seen_by_rays) {
  anemone::test::TempFolder folder;
  folder.write("wall.rib", "Color 1 0 0 Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0]");
  std::vector<float> p =
      render("Projection \"perspective\" \"fov\" 40 WorldBegin Surface \"mirror\" Translate 0 0 5 "
             "Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] Attribute \"visibility\" \"trace\" 1 "
             "Surface \"constant\" Translate 0 0 -9 Procedural \"DelayedReadArchive\" [\"" +
             (folder / "wall.rib").string() + "\"] [-99 99 -99 99 0 0] WorldEnd");
  EXPECT_EQ(messages_, "");
  EXPECT_NEAR(at(p, 24, 24, 0), 0.9f, 1e-3f);
}

TEST_F(RayPicture, what_is_seen_in_a_mirror_is_filtered) {
  // A far checked floor in a flat mirror, fine beyond pixels: filtered by what the ray covers it is grey all
  // over, whereas one sample of it would be black or white.
  shaders_["stripes"] =
      "surface stripes() { float w = abs(Du(s) * du) + abs(Dv(s) * dv), a = mod(s, 1), b = a + w;"
      "float whole = floor(b) * .5 + min(mod(b, 1), .5) - min(a, .5); Ci = w > 0 ? whole / w : (a < .5 ? 1 : "
      "0); Oi = 1; }";
  shaders_["clear"] = "surface clear() { Ci = trace(P, reflect(normalize(I), normalize(N))); Oi = 1; }";
  std::vector<float> p =
      render("PixelSamples 1 1 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 40 WorldBegin "
             "Surface \"clear\" Translate 0 0 5 Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] "
             "Attribute \"visibility\" \"trace\" 1 Surface \"stripes\" Translate 0 0 -60 "
             "Polygon \"P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0] WorldEnd");
  EXPECT_EQ(messages_, "");
  // 65 away, a pixel covers 65 * 2 tan(20) / 48 = 0.99 stripes.
  double mean = 0, squares = 0;
  for (int y = 8; y < 40; ++y)
    for (int x = 8; x < 40; ++x) {
      mean += at(p, x, y, 0) / 1024;
      squares += at(p, x, y, 0) * at(p, x, y, 0) / 1024;
    }
  EXPECT_NEAR(mean, 0.5, 0.02);
  EXPECT_LT(squares - mean * mean, 0.01) << "unfiltered it would be 0.25";
}

} // namespace
} // namespace render
