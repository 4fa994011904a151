// Maps that scenes make, and how maps are found and looked up.
#include "render/renderer.h"
#include "render/texture/find_image.h"
#include "render/texture/make_maps.h"
#include "render/texture/texture_maps.h"
#include "slvm/textures.h"
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace render::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr TextureWrap kPeriodic = TextureWrap::kPeriodic, kClamp = TextureWrap::kClamp;

class Maps : public ::testing::Test {
protected:
  std::string path(const std::string& name) { return (directory_ / name).string(); }

  /// A float image whose pixels are f(s, t).
  template <class F> std::string image(const std::string& name, int width, int height, F&& f) {
    OIIO::ImageBuf buffer(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        Color c = f((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
        buffer.setpixel(x, y, &c.x);
      }
    buffer.write(path(name));
    return path(name);
  }

  /// Renders a scene; its messages.
  static std::string run(const std::string& rib) {
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    Renderer renderer(sources, diagnostics);
    renderer.read_text("scene.rib", rib);
    renderer.finish();
    return format_diagnostics(diagnostics, sources);
  }

  /// One lookup of a region that is a point unless `width` or `blur` say more.
  Color look_up(std::string (TextureMaps::*call)(const slvm::TextureLookup&), const std::string& map, Vec3 at,
                float width = 0, float blur = 0) {
    slvm::TextureLookup l;
    uint64_t mask = 1;
    float result[3] = {};
    l.map = map;
    l.channels = 3;
    l.points = 1;
    l.mask = &mask;
    for (int c = 0; c < 3; ++c) {
      l.centre[c] = {at[c]};
      l.along_u[c] = {c == 0 ? width : 0};
      l.along_v[c] = {c == 1 ? width : 0};
      l.result[c] = &result[c];
    }
    l.sblur = l.tblur = {blur};
    TextureMaps::Settings settings;
    settings.folders = {directory_.string()};
    TextureMaps maps(settings);
    problem_ = (maps.*call)(l);
    replaced_ = maps.replaced();
    return {result[0], result[1], result[2]};
  }

  anemone::test::TempFolder directory_;
  std::string problem_;
  std::map<std::string, std::string> replaced_;
};

Color ramp(float s, float t) {
  return {s, t, 0.5f};
}

TEST_F(Maps, textures_have_levels_and_wraps) {
  std::string source = image("a.exr", 64, 64, ramp);
  ASSERT_EQ(make_texture(source, path("a.tex"), {kPeriodic, kClamp, FilterKind::kTriangle}), "");
  auto in = OIIO::ImageInput::open(path("a.tex"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().get_string_attribute("wrapmodes"), "periodic,clamp");
  EXPECT_GT(in->spec().tile_width, 0);
  EXPECT_TRUE(in->seek_subimage(0, 6)); // down to one pixel
  Color c = look_up(&TextureMaps::texture, path("a.tex"), {0.25f, 0.75f, 0});
  EXPECT_NEAR(c.x, 0.25f, 2e-3f);
  EXPECT_NEAR(c.y, 0.75f, 2e-3f);
  // Beyond the sides: round again in s, the last row in t.
  EXPECT_NEAR(look_up(&TextureMaps::texture, path("a.tex"), {1.25f, 0.5f, 0}).x, 0.25f, 2e-3f);
  EXPECT_NEAR(look_up(&TextureMaps::texture, path("a.tex"), {0.5f, 1.4f, 0}).y, 1, 0.01f);
  // The mean of all.
  EXPECT_NEAR(look_up(&TextureMaps::texture, path("a.tex"), {0.5f, 0.5f, 0}, 1).x, 0.5f, 0.05f);
}

/// All texels of all levels.
std::vector<float> all_texels(const std::string& path) {
  std::vector<float> out;
  auto in = OIIO::ImageInput::open(path);
  for (int level = 0; in && in->seek_subimage(0, level); ++level) {
    const OIIO::ImageSpec& spec = in->spec();
    std::vector<float> texels(static_cast<size_t>(spec.width * spec.height * spec.nchannels));
    EXPECT_TRUE(in->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texels.data()));
    out.insert(out.end(), texels.begin(), texels.end());
  }
  return out;
}

TEST_F(Maps, levels_are_those_of_openimageio) {
  const std::string source = image("a.tif", 64, 32, [](float s, float t) {
    const float noise = std::sin(s * 1234) * std::cos(t * 987);
    return Color(noise, s * t, noise * s);
  });
  OIIO::ImageBuf buffer(source);
  auto compare = [&](OIIO::ImageBufAlgo::MakeTextureMode mode, const std::string& filter,
                     const std::string& map) {
    SCOPED_TRACE(map + " " + filter);
    OIIO::ImageSpec config;
    config.attribute("maketx:filtername", filter);
    const bool flat = mode == OIIO::ImageBufAlgo::MakeTxTexture;
    config.attribute("wrapmodes", flat ? "clamp,clamp" : "periodic,clamp");
    ASSERT_TRUE(OIIO::ImageBufAlgo::make_texture(mode, buffer, path("theirs.tif"), config));
    const std::vector<float> own = all_texels(path(map)), theirs = all_texels(path("theirs.tif"));
    ASSERT_EQ(own.size(), theirs.size());
    for (size_t i = 0; i < own.size(); ++i)
      EXPECT_NEAR(own[i], theirs[i], 1e-4f);
    // What textureinfo() and other readers want to know.
    const OIIO::ImageSpec a = OIIO::ImageInput::open(path(map))->spec(),
                          b = OIIO::ImageInput::open(path("theirs.tif"))->spec();
    EXPECT_EQ(a.get_string_attribute("textureformat"), b.get_string_attribute("textureformat"));
    EXPECT_EQ(a.get_string_attribute("wrapmodes"), b.get_string_attribute("wrapmodes"));
    EXPECT_EQ(a.get_float_attribute("fovcot"), b.get_float_attribute("fovcot"));
    EXPECT_EQ(a.tile_width, b.tile_width);
    EXPECT_EQ(a.channelnames, b.channelnames);
  };
  for (const char* filter :
       {"box", "triangle", "gaussian", "catmull-rom", "sinc", "mitchell", "disk", "blackman-harris"}) {
    ASSERT_EQ(make_texture(source, path("a.tex"), {kClamp, kClamp, *find_filter(filter)}), "");
    compare(OIIO::ImageBufAlgo::MakeTxTexture, filter, "a.tex");
  }
  ASSERT_EQ(make_latlong(source, path("a.env"), {kPeriodic, kClamp}), "");
  compare(OIIO::ImageBufAlgo::MakeTxEnvLatl, "box", "a.env");
}

TEST_F(Maps, maps_have_the_numbers_of_their_images) {
  auto type_of = [&](const std::string& map) {
    return std::string(OIIO::ImageInput::open(path(map))->spec().format.c_str());
  };
  OIIO::ImageBuf buffer(OIIO::ImageSpec(8, 8, 3, OIIO::TypeDesc::UINT8));
  const float grey[3] = {0.2f, 0.4f, 0.6f};
  for (int i = 0; i < 64; ++i)
    buffer.setpixel(i % 8, i / 8, grey);
  for (const char* name : {"a.tif", "a.png"}) {
    ASSERT_TRUE(buffer.write(path(name)));
    ASSERT_EQ(make_texture(path(name), path("a.tex"), {}), "");
    EXPECT_EQ(type_of("a.tex"), "uint8");
    for (float v : all_texels(path("a.tex")))
      EXPECT_NEAR(std::abs(v - 0.4f), v > 0.3f && v < 0.5f ? 0 : 0.2f, 1e-6f);
    // Steps would show.
    ASSERT_EQ(make_texture(path(name), path("soft.tex"), {kPeriodic, kClamp, FilterKind::kGaussian, 4, 4}),
              "");
    EXPECT_EQ(type_of("soft.tex"), "float");
    ASSERT_EQ(make_bump(path(name), path("a.bump"), {}), "");
    EXPECT_EQ(type_of("a.bump"), "float");
    ASSERT_EQ(make_texture(path(name), path("a.exr"), {}), "");
    EXPECT_EQ(type_of("a.exr"), "float");
    EXPECT_TRUE(OIIO::ImageInput::open(path("a.exr"))->seek_subimage(0, 3));
    EXPECT_EQ(OIIO::ImageInput::open(path("a.exr"))->spec().get_string_attribute("wrapmodes"), "black,black");
  }
}

TEST_F(Maps, an_image_may_be_written_anew) {
  for (int size : {16, 64, 32}) {
    std::string source = image("a.exr", size, size, ramp);
    ASSERT_EQ(make_texture(source, path("a.tex"), {}), "");
    EXPECT_EQ(OIIO::ImageInput::open(path("a.tex"))->spec().width, size);
  }
}

/// The colour of a direction: exact where an environment map is a smooth function of it.
Color of_direction(Vec3 d) {
  return Color(0.5f) + 0.5f * glm::normalize(d);
}

const Vec3 kDirections[] = {{1, 0, 0},        {0, 1, 0},      {0, 0, 1},       {-1, 0, 0},
                            {0, -1, 0},       {0, 0, -1},     {1, 1, 1},       {-1, 2, .5f},
                            {.3f, -.2f, 1},   {.1f, .2f, -3}, {1, .99f, -.2f}, {-.5f, -.5f, .51f},
                            {-1, .001f, .1f}, {1, -.001f, 0}};

TEST_F(Maps, latlong_environments_point_where_the_image_says) {
  std::string source = image("sky.exr", 256, 128, [](float s, float t) {
    float lon = s * 2 * kPi, lat = (0.5f - t) * kPi;
    return of_direction({std::cos(lon) * std::cos(lat), std::sin(lon) * std::cos(lat), std::sin(lat)});
  });
  ASSERT_EQ(make_latlong(source, path("sky.env"), {kPeriodic, kClamp, FilterKind::kBox}), "");
  for (Vec3 d : kDirections) {
    Color c = look_up(&TextureMaps::environment, path("sky.env"), d), want = of_direction(d);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(c[i], want[i], 0.01f) << d.x << " " << d.y << " " << d.z;
  }
}

/// One half of the sky is bright. Above, a blurred lookup sees as much of it as of the other half, whichever
/// way it leans by a hair.
TEST_F(Maps, blurred_lookups_at_a_pole_see_all_longitudes) {
  const std::string source =
      image("half.exr", 256, 128, [](float s, float) { return Color(s < 0.5f ? 1.0f : 0.0f); });
  ASSERT_EQ(make_latlong(source, path("half.env"), {kPeriodic, kClamp, FilterKind::kBox}), "");
  const Vec3 leans[] = {{0, 0, 0}, {1e-4f, 0, 0}, {0, 1e-4f, 0}, {0, -1e-4f, 0}, {0, -2e-3f, 0}};
  auto bright = [&](Vec3 d, float width, float blur) {
    return look_up(&TextureMaps::environment, path("half.env"), d, width, blur).x;
  };
  for (float z : {1.0f, -1.0f})
    for (Vec3 lean : leans) {
      EXPECT_NEAR(bright(Vec3(0, 0, z) + lean, 0, 0.05f), 0.5f, 0.02f) << z << " " << lean.x << " " << lean.y;
      EXPECT_NEAR(bright(Vec3(0, 0, z) + lean, 0.1f, 0), 0.5f, 0.02f) << z << " " << lean.x << " " << lean.y;
    }
  for (float y : {0.3f, -0.3f}) {
    EXPECT_NEAR(bright({0, y, 1}, 0, 0.05f), y > 0 ? 1 : 0, 0.02f);
    EXPECT_NEAR(bright({0, y, 1}, 0.1f, 0), y > 0 ? 1 : 0, 0.02f);
  }
}

TEST_F(Maps, wide_filters_soften_textures) {
  const std::string source = image("a.exr", 8, 8, [](float s, float t) {
    return Color(s < 0.125f ? 8.0f : 0.0f, t < 0.125f ? 8.0f : 0.0f, 1.0f);
  });
  MakeSettings settings{kPeriodic, kClamp, FilterKind::kBox, 4, 2};
  ASSERT_EQ(make_texture(source, path("a.tex"), settings), "");
  auto texel = [&](int x, int y) {
    return look_up(&TextureMaps::texture, path("a.tex"),
                   {(static_cast<float>(x) + 0.5f) / 8, (static_cast<float>(y) + 0.5f) / 8, 0});
  };
  // A box of 4 takes half of the outermost ones: of a column of 8 what falls on the columns about it, round
  // again.
  const float across[] = {2, 2, 1, 0, 0, 0, 1, 2}, down[] = {6, 2, 0, 0, 0, 0, 0, 0};
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(texel(i, 4).x, across[i], 1e-4f) << i;
    EXPECT_NEAR(texel(4, i).y, down[i], 1e-4f) << i;
    EXPECT_NEAR(texel(i, i).z, 1, 1e-5f) << i;
  }
  // Beyond a black side there is nothing.
  settings.swrap = TextureWrap::kBlack;
  ASSERT_EQ(make_texture(source, path("a.tex"), settings), "");
  EXPECT_NEAR(texel(0, 4).x, 2, 1e-4f);
  EXPECT_NEAR(texel(0, 4).z, 0.625f, 1e-4f);
  EXPECT_NEAR(texel(7, 4).x, 0, 1e-4f);
  // Usual widths change nothing.
  for (const FilterKind filter : {FilterKind::kGaussian, FilterKind::kTriangle}) {
    settings = {kPeriodic, kClamp, filter, 2, 2};
    ASSERT_EQ(make_texture(source, path("a.tex"), settings), "");
    EXPECT_NEAR(texel(0, 4).x, 8, 1e-4f);
    EXPECT_NEAR(texel(1, 4).x, 0, 1e-4f);
  }
  // A triangle as wide as 4: 1/4, 1/2, 1/4.
  settings = {kPeriodic, kClamp, FilterKind::kTriangle, 4, 4};
  ASSERT_EQ(make_texture(source, path("a.tex"), settings), "");
  EXPECT_NEAR(texel(0, 4).x, 4, 1e-4f);
  EXPECT_NEAR(texel(1, 4).x, 2, 1e-4f);
  EXPECT_NEAR(texel(7, 4).x, 2, 1e-4f);
}

TEST_F(Maps, wide_filters_soften_environments_by_the_same_angle_everywhere) {
  // A sun of some degrees at the equator, at 60 degrees and at the pole: the gaussian of 32 of 256 pixels
  // takes 45 degrees across, so that the sun becomes a spot whose middle is as bright wherever it stands.
  float middle[3];
  for (size_t k = 0; k < 3; ++k) {
    const float latitude = std::array{0.0f, kPi / 3, kPi / 2 - 0.01f}[k];
    const Vec3 sun(std::cos(latitude), 0, std::sin(latitude));
    const std::string source = image("sky.exr", 256, 128, [&](float s, float t) {
      float lon = s * 2 * kPi, lat = (0.5f - t) * kPi;
      const Vec3 d(std::cos(lon) * std::cos(lat), std::sin(lon) * std::cos(lat), std::sin(lat));
      return Color(glm::dot(d, sun) > std::cos(0.1f) ? 100.0f : 0.0f, 1.0f, 0.5f);
    });
    ASSERT_EQ(make_latlong(source, path("sky.env"), {kPeriodic, kClamp, FilterKind::kGaussian, 32, 32}), "");
    Color c = look_up(&TextureMaps::environment, path("sky.env"), sun);
    middle[k] = c.x;
    EXPECT_NEAR(c.y, 1, 1e-3f);
    // Across a seam or a pole the spot is as wide on both sides.
    for (float turn : {0.15f, 0.25f}) {
      const Vec3 up(-std::sin(latitude), 0, std::cos(latitude));
      const float a = look_up(&TextureMaps::environment, path("sky.env"), sun + turn * up).x,
                  b = look_up(&TextureMaps::environment, path("sky.env"), sun - turn * up).x;
      EXPECT_NEAR(a, b, 0.1f * middle[k]) << k;
      EXPECT_LT(a, middle[k]);
    }
  }
  // The sun's part of exp(-2 (r / R)^2) to R = 22.5 degrees: as if all were flat.
  const double whole = 1 - std::exp(-2.0),
               expected = 100 * (1 - std::exp(-2 * std::pow(0.1 / (kPi / 8), 2))) / whole;
  EXPECT_NEAR(middle[0], expected, 0.1 * expected);
  EXPECT_NEAR(middle[1], middle[0], 0.1f * middle[0]);
  EXPECT_NEAR(middle[2], middle[0], 0.2f * middle[0]);
}

TEST_F(Maps, what_a_scene_asks_of_filters_of_maps) {
  const std::string source = image("a.exr", 8, 8, ramp);
  auto make = [&](const std::string& filter) {
    return run("MakeLatLongEnvironment \"" + source + "\" \"" + path("a.env") + "\" " + filter);
  };
  EXPECT_EQ(make("\"gaussian\" 4 4"), "");
  EXPECT_EQ(make("\"box\" 1 1"), "");
  EXPECT_EQ(make("\"catmull-rom\" 1 1"), "");
  EXPECT_THAT(
      make("\"catmull-rom\" 9 9"),
      HasSubstr(
          "this filter of maps has a width of its own: swidth and twidth have no effect; they count for "
          "box, triangle and gaussian"));
  EXPECT_THAT(make("\"box\" 1 0"), HasSubstr("twidth is a number of pixels above 0, found 0"));
}

TEST_F(Maps, six_faces_become_one_environment) {
  // Seen from the middle, with 95 degrees: forward, up, right.
  const Vec3 axes[6][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                           {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}};
  float wide = std::tan(95 * kPi / 360);
  std::array<std::string, 6> faces;
  for (size_t i = 0; i < 6; ++i)
    faces[i] = image("face" + std::to_string(i) + ".exr", 64, 64, [&](float s, float t) {
      return of_direction(axes[i][0] + axes[i][1] * (wide * (1 - 2 * t)) + axes[i][2] * (wide * (2 * s - 1)));
    });
  ASSERT_EQ(make_cube_environment(faces, path("cube.env"), 95, {kPeriodic, kClamp, FilterKind::kBox}), "");
  for (Vec3 d : kDirections) {
    Color c = look_up(&TextureMaps::environment, path("cube.env"), d), want = of_direction(d);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(c[i], want[i], 0.015f) << d.x << " " << d.y << " " << d.z;
  }
}

/// Along the edges of the cube, from one face to the next: no step larger than that of the image itself.
TEST_F(Maps, faces_of_exactly_ninety_degrees_have_no_seams) {
  const Vec3 axes[6][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                           {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}};
  std::array<std::string, 6> faces;
  for (size_t i = 0; i < 6; ++i) // eight pixels a side: a step from pixel to pixel is large
    faces[i] = image("face" + std::to_string(i) + ".exr", 8, 8, [&](float s, float t) {
      return of_direction(axes[i][0] + axes[i][1] * (1 - 2 * t) + axes[i][2] * (2 * s - 1));
    });
  ASSERT_EQ(make_cube_environment(faces, path("cube.env"), 90, {kPeriodic, kClamp, FilterKind::kBox}), "");
  OIIO::ImageBuf map(path("cube.env"));
  ASSERT_TRUE(map.read(0, 0, true, OIIO::TypeDesc::FLOAT));
  ASSERT_EQ(map.spec().width, 32);
  float worst = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) {
      float lon = (static_cast<float>(x) + 0.5f) / 32 * 2 * kPi,
            lat = (0.5f - (static_cast<float>(y) + 0.5f) / 16) * kPi;
      Color want =
          of_direction({std::cos(lon) * std::cos(lat), std::sin(lon) * std::cos(lat), std::sin(lat)});
      for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(map.getchannel(x, y, 0, c) - want[c]));
    }
  // Half a pixel of a face is 0.06; blending across the edges leaves the curvature only.
  EXPECT_LT(worst, 0.02f);
}

TEST_F(Maps, bump_maps_are_textures_of_heights) {
  std::string source = image("a.exr", 64, 64, ramp);
  ASSERT_EQ(make_bump(source, path("a.bump"), {kPeriodic, kClamp, FilterKind::kBox}), "");
  auto in = OIIO::ImageInput::open(path("a.bump"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().nchannels, 1);
  EXPECT_NEAR(look_up(&TextureMaps::texture, path("a.bump"), {0.25f, 0.75f, 0}).x, 0.25f, 2e-3f);
}

TEST_F(Maps, what_cannot_be_made_is_said_and_leaves_nothing) {
  EXPECT_THAT(make_texture(path("none.tif"), path("a.tex"), {}), HasSubstr("cannot read"));
  std::string source = image("a.exr", 8, 8, ramp);
  EXPECT_THAT(make_texture(source, path("no/folder/a.tex"), {}), HasSubstr("cannot make"));
  EXPECT_THAT(make_shadow(source, path("a.shd")), HasSubstr("lacks the matrix worldtocamera"));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 1);
}

TEST_F(Maps, requests_make_maps_and_name_mistakes) {
  auto messages = [&](const std::string& rib) {
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    Renderer renderer(sources, diagnostics);
    renderer.read_text("scene.rib", rib);
    renderer.finish();
    return format_diagnostics(diagnostics, sources);
  };
  std::string source = image("a.exr", 8, 8, ramp);
  EXPECT_EQ(messages("Option \"searchpath\" \"texture\" \"" + directory_.string() +
                     "\" MakeTexture \"a.exr\" \"" + path("a.tex") +
                     "\" \"periodic\" \"black\" \"gaussian\" 1 1"),
            "");
  EXPECT_THAT(
      messages("MakeLatLongEnvironment \"" + source + "\" \"" + path("a.env") + "\" \"mitchell\" 2 3"),
      HasSubstr("swidth and twidth have no effect"));
  EXPECT_TRUE(fs::exists(path("a.tex")));
  EXPECT_THAT(messages("MakeTexture \"" + source + "\" \"b\" \"round\" \"black\" \"box\" 1 1"),
              HasSubstr("MakeTexture: unknown wrap \"round\"; known are black, periodic, clamp"));
  EXPECT_THAT(messages("MakeLatLongEnvironment \"" + source + "\" \"b\" \"bax\" 1 1"),
              HasSubstr("MakeLatLongEnvironment: unknown filter \"bax\"; known are box"));
  EXPECT_THAT(messages("MakeCubeFaceEnvironment \"a\" \"a\" \"a\" \"a\" \"a\" \"a\" \"b\" 80 \"box\" 1 1"),
              HasSubstr("the faces need 90 degrees or a little more, found 80"));
  EXPECT_THAT(messages("MakeShadow \"nowhere.z\" \"b\""), HasSubstr("MakeShadow: cannot read \"nowhere.z\""));
}

TEST_F(Maps, missing_maps_are_found_under_other_names) {
  image("wood.tif", 8, 8, ramp);
  std::vector<std::string> folders{directory_.string()};
  for (const char* name :
       {"wood.tif", "wood.tx", "wood.tex", "wood", "/net/show/maps/wood.tx", "C:\\maps\\wood.tif"})
    EXPECT_EQ(find_image(name, folders), path("wood.tif")) << name;
  EXPECT_FALSE(find_image("stone.tx", folders));
  EXPECT_FALSE(find_image("", folders));
  EXPECT_NEAR(look_up(&TextureMaps::texture, "wood.tx", {0.5f, 0.5f, 0}).z, 0.5f, 1e-3f);
  EXPECT_EQ(problem_, "");
  EXPECT_EQ(replaced_["wood.tx"], path("wood.tif"));
  look_up(&TextureMaps::texture, "wood.tif", {0.5f, 0.5f, 0});
  EXPECT_TRUE(replaced_.empty());
  for (auto call : {&TextureMaps::texture, &TextureMaps::environment, &TextureMaps::shadow}) {
    look_up(call, "stone.tx", {0.5f, 0.5f, 1});
    EXPECT_EQ(problem_, "no such file in the texture search path");
  }
}

TEST_F(Maps, a_rendered_depth_becomes_a_shadow_map_and_a_mask) {
  std::string head = "Format 16 16 1 PixelFilter \"box\" 1 1 ";
  EXPECT_EQ(run(head + "PixelSamples 2 2 Hider \"hidden\" \"int jitter\" 0 \"int subpixel\" 1 Display \"" +
                path("d.z") +
                "\" \"zfile\" \"z\" WorldBegin Translate 0 0 3 Disk 0 .5 360 WorldEnd MakeShadow \"" +
                path("d.z") + "\" \"" + path("d.shd") + "\""),
            "");
  // Of a far wall the mask shows what is behind the disk, of a near one nothing.
  auto alpha = [&](const std::string& parameters, const char* z, int x, int y) {
    EXPECT_EQ(run(head + "PixelSamples 2 2 Hider \"depthmask\" \"zfile\" \"" + path("d.shd") + "\" " +
                  parameters + " Display \"" + path("out.exr") +
                  "\" \"openexr\" \"rgba\" WorldBegin Translate 0 0 " + z +
                  " Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] WorldEnd"),
              "");
    OIIO::ImageBuf out(path("out.exr"));
    out.read(0, 0, true); // not from the cache, which knows the last one
    return out.getchannel(x, y, 0, 3);
  };
  EXPECT_EQ(alpha("", "5", 8, 8), 1);
  EXPECT_EQ(alpha("", "5", 1, 8), 0);
  EXPECT_EQ(alpha("", "2", 8, 8), 0);
  EXPECT_EQ(alpha("\"reversesign\" 1", "5", 8, 8), 0);
  EXPECT_EQ(alpha("\"reversesign\" 1", "5", 1, 8), 1);
  EXPECT_EQ(alpha("\"depthbias\" -1", "2.5", 8, 8), 1);
  EXPECT_THAT(
      run("Hider \"depthmask\" \"zfile\" \"nowhere.z\" Display \"x\" \"null\" \"rgb\" WorldBegin WorldEnd"),
      HasSubstr("Hider: \"nowhere.z\": no such file in the texture search path"));
}

TEST_F(Maps, a_blobby_is_repelled_by_what_a_depth_image_shows) {
  // The ground is a disk at world z = 4; the ball around it would reach to z = 5.
  std::string frame = "Format 32 32 1 PixelSamples 2 2 ";
  std::string ball =
      "Blobby 2 [1001 0 1003 0 16 0 2 0 1] [2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1  .4 .02 .2 .1] [\"" +
      path("ground.z") + "\"] ";
  EXPECT_EQ(run("FrameBegin 1 " + frame + "Display \"" + path("ground.z") +
                "\" \"zfile\" \"z\" WorldBegin Translate 0 0 4 Disk 0 3 360 WorldEnd FrameEnd FrameBegin 2 " +
                frame + "Display \"" + path("ball.exr") +
                "\" \"openexr\" \"z\" Rotate 180 0 1 0 Translate 0 0 -9 WorldBegin Translate 0 0 4 " + ball +
                "WorldEnd FrameEnd"),
            "");
  // Seen from behind at z = 9, its back is flat and close to the ground: without it the depth would be 4.
  OIIO::ImageBuf z(path("ball.exr"));
  float depth = 0;
  ASSERT_TRUE(z.read());
  z.getpixel(16, 16, &depth, 1);
  EXPECT_GT(depth, 5);
  EXPECT_LT(depth, 5.1f);
}

} // namespace
} // namespace render::testing
