// Light below surfaces in several passes, beside closed forms: points from grids, lit and looked up; shadow
// maps.
#include "stdlib/subsurface/point_cloud.h"
#include "tests/render/run_slrender.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

using ::testing::HasSubstr;

class SubsurfacePasses : public anemone::test::SlrenderTest {
protected:
  void render(const std::string& rib, const std::string& arguments = "") {
    file("a.rib", rib);
    const Outcome o = run(arguments + " a.rib");
    EXPECT_EQ(o.text, "");
    EXPECT_EQ(o.status, 0);
  }
  /// The mean of a channel of all pixels.
  double mean(const std::string& name, size_t channel = 0) {
    const auto p = pixels(name);
    double sum = 0;
    for (size_t i = channel; i < p.size(); i += 3)
      sum += static_cast<double>(p[i]);
    EXPECT_FALSE(p.empty());
    return sum / static_cast<double>(p.size() / 3);
  }
  /// One pixel of the middle.
  double middle(const std::string& name, size_t channel = 0) {
    const auto p = pixels(name);
    const size_t side = p.empty() ? 0 : static_cast<size_t>(std::sqrt(static_cast<double>(p.size()) / 3));
    return p.empty() ? -1 : static_cast<double>(p[3 * (side / 2 * side + side / 2) + channel]);
  }
};

/// A frame with a camera above the middle of a plate, 2 `window` wide.
std::string frame(int number, const std::string& output, double window, int pixels,
                  const std::string& world) {
  return fmt::format(
      "FrameBegin {}\nFormat {} {} 1\nPixelSamples 1 1\nPixelFilter \"box\" 1 1\n"
      "Display \"{}\" \"tiff\" \"rgb\" \"float[4] quantize\" [0 0 0 0]\nProjection \"orthographic\"\n"
      "ScreenWindow {} {} {} {}\nTranslate 0 0 20\nWorldBegin\n{}\nWorldEnd\nFrameEnd\n",
      number, pixels, pixels, output, -window, window, -window, window, world);
}

const char* const kSlantedLight =
    "LightSource \"distantlight\" 1 \"from\" [-0.8660254 0 -0.5] \"to\" [0 0 0] \"intensity\" 2\n";
const char* const kPlate = "Polygon \"P\" [-10 -10 0 -10 10 0 10 10 0 10 -10 0]\n";

// In even light the middle of a wide plate returns its albedo: V6 of the course's figures.
TEST_F(SubsurfacePasses, PointsFromGridsLitByTheLightPass) {
  render(frame(1, "null.tif", 11, 330,
               std::string("Surface \"bakepoints\" \"file\" \"points.ply\"\n") + kPlate) +
         frame(2, "null.tif", 11, 8,
               std::string(kSlantedLight) +
                   "Surface \"lightpoints\" \"input\" \"points.ply\" \"result\" \"lit.ply\"\n"
                   "Points \"P\" [0 0 0] \"constantwidth\" 1") +
         frame(3, "out.tif", 0.5, 8,
               std::string("Surface \"translucentsolid\" \"cloud\" \"lit.ply\" \"color albedo\" [.8 .5 .2]"
                           " \"color freepath\" [2 1 1] \"eta\" 1.3 \"Kspecular\" 0\n") +
                   kPlate));
  const auto points = subsurface::read_point_cloud((directory_ / "points.ply").string());
  ASSERT_TRUE(points);
  EXPECT_NEAR(points->total_area(), 400, 0.1);
  EXPECT_TRUE(points->irradiance.empty());
  const auto lit = subsurface::read_point_cloud((directory_ / "lit.ply").string());
  ASSERT_TRUE(lit);
  ASSERT_EQ(lit->size(), points->size());
  for (const subsurface::Color& E : lit->irradiance)
    EXPECT_NEAR(E.x, 1, 1e-5);
  const double out = 0.98298677; // Ft straight out, eta 1.3
  EXPECT_NEAR(middle("out.tif", 0), 0.8 * out, 0.012);
  EXPECT_NEAR(middle("out.tif", 1), 0.5 * out, 0.004);
  EXPECT_NEAR(middle("out.tif", 2), 0.2 * out, 0.002);
}

TEST_F(SubsurfacePasses, ColoursOfPointsAndLightAtOnce) {
  render(frame(1, "null.tif", 11, 330,
               std::string(kSlantedLight) +
                   "Color .6 .4 .1\nSurface \"bakepoints\" \"file\" \"lit.ply\" \"lit\" 1\n" + kPlate) +
         frame(2, "out.tif", 0.5, 8,
               std::string("Surface \"translucentsolid\" \"cloud\" \"lit.ply\" \"textured\" 1"
                           " \"color freepath\" [2 1 1] \"eta\" 1.3 \"Kspecular\" 0\n") +
                   kPlate));
  EXPECT_NEAR(middle("out.tif", 0), 0.6 * 0.983, 0.006);
  EXPECT_NEAR(middle("out.tif", 1), 0.4 * 0.983, 0.004);
  EXPECT_NEAR(middle("out.tif", 2), 0.1 * 0.983, 0.001);
}

TEST_F(SubsurfacePasses, TheSamePictureForAnyNumberOfThreads) {
  auto passes = [&](const std::string& picture) {
    return frame(1, "null.tif", 1.5, 100,
                 std::string(kSlantedLight) +
                     "Attribute \"cull\" \"hidden\" 0 \"backfacing\" 0\n"
                     "Surface \"bakepoints\" \"file\" \"ball.ply\" \"lit\" 1\nSphere 1 -1 1 360") +
           frame(2, picture, 1.5, 32,
                 "Surface \"translucentsolid\" \"cloud\" \"ball.ply\" \"material\" \"skin2\" \"mm\" "
                 ".1\nSphere 1 -1 1 360");
  };
  render(passes("one.tif"), "-t:1");
  const std::string cloud = directory_.read("ball.ply");
  render(passes("four.tif"), "-t:4");
  EXPECT_EQ(cloud, directory_.read("ball.ply"));
  EXPECT_EQ(pixels("one.tif"), pixels("four.tif"));
}

// What is inside takes away a part of what the same surface outside would give.
TEST_F(SubsurfacePasses, BlockingByACloudInside) {
  auto look = [&](const std::string& inner) {
    render(frame(1, "null.tif", 11, 330,
                 std::string(kSlantedLight) + "Surface \"bakepoints\" \"file\" \"lit.ply\" \"lit\" 1\n" +
                     kPlate) +
           frame(2, "out.tif", 0.5, 8,
                 "Surface \"translucentsolid\" \"cloud\" \"lit.ply\" \"string inner\" \"" + inner +
                     "\" \"blocking\" .25 \"color albedo\" [.8 .5 .2]"
                     " \"color freepath\" [2 1 1] \"eta\" 1.3 \"Kspecular\" 0\n" +
                     kPlate));
    return middle("out.tif", 1);
  };
  const double plain = look("");
  EXPECT_NEAR(look("lit.ply"), 0.75 * plain, 1e-4);
}

const char* const kByMap = "#include \"subsurface.h\"\n"
                           R"(
surface bymap(uniform string map = "", normals = "", inner = "", outer = ""; uniform float diffusion = 0;) {
  vector In = normalize(I);
  normal Nn = normalize(N);
  color c = 0;
  illuminance(P, Nn, PI) {
    if (diffusion == 0)
      c += Cl * pastothers(outer, P) * singlescatteringbymap(P, Nn, In, L, .2, 1.8, .6, 1.4, 16, map, normals, inner, .05, 0);
    else
      c += Cl * pastothers(outer, P) * diffusionscatteringbymap(P, L, color (.8, .5, .5), color (.2, .2, .1), 1.3, 64, map, inner, .05, 0);
  }
  Oi = 1;
  Ci = c;
}
)";

class SubsurfaceByMaps : public SubsurfacePasses {
protected:
  /// A frame of a light's view along (sin 60, 0, cos 60) on the origin: NAMEz.tif and NAMEn.tif.
  static std::string light_view(int number, const std::string& name, const std::string& projection,
                                const std::string& world) {
    return fmt::format(
        "FrameBegin {0}\nFormat 256 256 1\nPixelSamples 1 1\nPixelFilter \"box\" 1 1\n"
        "Hider \"hidden\" \"int jitter\" 0\nDisplay \"{1}z.tif\" \"zfile\" \"z\"\n"
        "Display \"+{1}n.tif\" \"tiff\" \"varying normal N\" \"float[4] quantize\" [0 0 0 0]\n{2}\n"
        "Translate 0 0 80\nRotate -60 0 1 0\nWorldBegin\nSurface \"constant\"\n{3}\nWorldEnd\nFrameEnd\n",
        number, name, projection, world);
  }
  static std::string picture(int number, const std::string& output, const std::string& parameters) {
    return frame(
        number, output, 0.3, 48,
        "LightSource \"distantlight\" 1 \"from\" [-0.8660254 0 -0.5] \"to\" [0 0 0]\nSurface \"bymap\" " +
            parameters + "\n" + kPlate);
  }
  void SetUp() override { file("bymap.sl", kByMap); }
  static constexpr const char* kStraight = "Projection \"orthographic\"\nScreenWindow -1.5 1.5 -1.5 1.5";
};

// The closed form of single scattering on a half-space, by which terms.toml checks rays; half the light of 60
// degrees times the albedo.
TEST_F(SubsurfaceByMaps, OfLightsWithParallelAndWithSpreadingRays) {
  for (const char* projection : {kStraight, "Projection \"perspective\" \"fov\" 2.2"}) {
    render(light_view(1, "l", projection, kPlate) +
           picture(2, "single.tif", "\"map\" \"lz.tif\" \"normals\" \"ln.tif\"") +
           picture(3, "diffusion.tif", "\"map\" \"lz.tif\" \"diffusion\" 1"));
    EXPECT_NEAR(mean("single.tif"), 0.0054629, 0.0001) << projection;
    EXPECT_NEAR(mean("diffusion.tif", 0), 0.4, 0.03) << projection;
    EXPECT_NEAR(mean("diffusion.tif", 1), 0.25, 0.004) << projection;
    EXPECT_NEAR(mean("diffusion.tif", 2), 0.25, 0.006) << projection;
  }
}

// Something that the light's view meets before it reaches the samples lets nothing through; behind them it
// does not count.
TEST_F(SubsurfaceByMaps, BlockersInside) {
  const std::string above = "Polygon \"P\" [-10 -10 -1 -10 10 -1 10 10 -1 10 -10 -1]\n",
                    below = "Polygon \"P\" [-10 -10 9 -10 10 9 10 10 9 10 -10 9]\n";
  for (const char* diffusion : {"0", "1"}) {
    const std::string maps =
        std::string("\"map\" \"lz.tif\" \"normals\" \"ln.tif\" \"diffusion\" ") + diffusion;
    render(light_view(1, "l", kStraight, kPlate) + light_view(2, "above", kStraight, above) +
           light_view(3, "below", kStraight, below) + picture(4, "free.tif", maps) +
           picture(5, "above.tif", maps + " \"inner\" \"abovez.tif\"") +
           picture(7, "shaded.tif", maps + " \"outer\" \"abovez.tif\"") +
           picture(8, "free2.tif", maps + " \"outer\" \"belowz.tif\"") +
           picture(6, "below.tif", maps + " \"inner\" \"belowz.tif\""));
    EXPECT_LT(mean("above.tif"), 1e-5); // beyond the edge of the map nothing blocks
    EXPECT_LT(mean("shaded.tif"), 1e-5);
    EXPECT_EQ(pixels("free2.tif"), pixels("free.tif"));
    EXPECT_GT(mean("free.tif"), 0.005);
    EXPECT_EQ(pixels("below.tif"), pixels("free.tif"));
  }
}

// Lights that are no points: the edge of what a map shows is as wide as the lookups are spread. Of a disc
// whose middle is half its radius beyond the edge a circular segment is on this side.
TEST_F(SubsurfaceByMaps, JitteredLookupsHaveSoftEdges) {
  file("edge.sl", "#include \"subsurface.h\"\n"
                  R"(
surface edge(uniform string map = ""; uniform float x = 0, blur = 0;) {
  point p = transform("world", "current", point (x, 0, 5)), Pi = 0;
  float found = 0;
  uniform float i;
  for (i = 0; i < 100; i += 1)
    found += entrybymap(map, p, besideinmap(blur), Pi);
  Oi = 1;
  Ci = found / 100;
}
)");
  const std::string half = "FrameBegin 1\nFormat 256 256 1\nPixelSamples 1 1\nPixelFilter \"box\" 1 1\n"
                           "Hider \"hidden\" \"int jitter\" 0\nDisplay \"h.tif\" \"zfile\" \"z\"\n" +
                           std::string(kStraight) +
                           "\nTranslate 0 0 80\nWorldBegin\nSurface \"constant\"\n"
                           "Polygon \"P\" [-10 -10 0 -10 10 0 0 10 0 0 -10 0]\nWorldEnd\nFrameEnd\n";
  render(half);
  auto found = [&](double x, double blur) {
    render(
        frame(1, "edge.tif", 0.3, 16,
              fmt::format("Surface \"edge\" \"map\" \"h.tif\" \"x\" {} \"blur\" {}\n{}", x, blur, kPlate)));
    return mean("edge.tif");
  };
  EXPECT_EQ(found(-0.1, 0), 1);
  EXPECT_EQ(found(0.1, 0), 0);
  EXPECT_NEAR(found(0, 0.1), 0.5, 0.02);
  const double segment = (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / 3.14159265358979; // 0.1955
  EXPECT_NEAR(found(3 * 0.025, 0.1), segment, 0.015);                                 // the map is 3 wide
  EXPECT_NEAR(found(-3 * 0.025, 0.1), 1 - segment, 0.015);
  EXPECT_EQ(found(3 * 0.06, 0.1), 0);
}

// A surface that calls the built-in function, and one that calls the plug-in's.
const char* const kBuiltIn = R"(
surface builtin(uniform string cloud = "";) {
  Oi = 1;
  Ci = subsurface(P, N, "filename", cloud, "albedo", color (.8, .5, .2), "diffusemeanfreepath", color (2, 1, 1));
}
)";
const char* const kPluggedIn = R"(
surface pluggedin(uniform string cloud = "";) {
  Oi = 1;
  Ci = diffusion(transform("world", P), cloud, color (.8, .5, .2), color (2, 1, 1), 1.3, .05);
}
)";

/// Passes for a plate lit from above: its cloud, and pictures of it.
std::string lit_plate(int number, const std::string& cloud, double light) {
  return frame(
      number, "null.tif", 11, 200,
      fmt::format("LightSource \"distantlight\" 1 \"from\" [0 0 -1] \"to\" [0 0 0] \"intensity\" {}\n"
                  "Surface \"bakepoints\" \"file\" \"{}\" \"lit\" 1\n{}",
                  light, cloud, kPlate));
}
std::string look(int number, const std::string& output, const std::string& surface,
                 const std::string& cloud) {
  return frame(number, output, 0.5, 8,
               fmt::format("Surface \"{}\" \"cloud\" \"{}\"\n{}", surface, cloud, kPlate));
}

TEST_F(SubsurfacePasses, TheBuiltInFunctionAndThePlugInAgree) {
  file("builtin.sl", kBuiltIn);
  file("pluggedin.sl", kPluggedIn);
  std::filesystem::create_directories(directory_ / "maps");
  render(lit_plate(1, "maps/lit.ply", 1) + look(2, "plug.tif", "pluggedin", "maps/lit.ply") +
         "Option \"searchpath\" \"texture\" \"maps\"\n" + look(3, "built.tif", "builtin", "lit.ply"));
  const auto built = pixels("built.tif"), plugged = pixels("plug.tif");
  ASSERT_EQ(built.size(), plugged.size());
  for (size_t i = 0; i < built.size(); ++i)
    EXPECT_NEAR(built[i], plugged[i], 1e-5f);
  EXPECT_NEAR(middle("built.tif", 0), 0.8, 0.02);
  EXPECT_NEAR(middle("built.tif", 1), 0.5, 0.005);
}

// What frames keep is good until a pass writes the cloud anew.
TEST_F(SubsurfacePasses, AFrameSeesTheCloudOfThePassBefore) {
  file("builtin.sl", kBuiltIn);
  file("pluggedin.sl", kPluggedIn);
  for (const char* surface : {"builtin", "pluggedin"}) {
    render(lit_plate(1, "lit.ply", 1) + look(2, "one.tif", surface, "lit.ply") + lit_plate(3, "lit.ply", 2) +
           look(4, "two.tif", surface, "lit.ply"));
    EXPECT_NEAR(middle("two.tif", 1), 2 * middle("one.tif", 1), 1e-4) << surface;
  }
}

TEST_F(SubsurfacePasses, TreesAreKeptBetweenRunsWhereTheSceneSays) {
  file("builtin.sl", kBuiltIn);
  file("pluggedin.sl", kPluggedIn);
  namespace fs = std::filesystem;
  const std::string option = "Option \"subsurface\" \"string treefolder\" \"trees\"\n";
  auto tree_times = [&] {
    std::vector<fs::file_time_type> times;
    for (const auto& entry : fs::directory_iterator(directory_ / "trees"))
      times.push_back(entry.last_write_time());
    return times;
  };
  render(lit_plate(1, "lit.ply", 1));
  render(look(1, "one.tif", "builtin", "lit.ply"));
  EXPECT_FALSE(fs::exists(directory_ / "trees"));
  render(option + look(1, "two.tif", "builtin", "lit.ply"));
  const auto first = tree_times();
  ASSERT_EQ(first.size(), 1u);
  for (const char* surface : {"builtin", "pluggedin"}) {
    render(option + look(1, "three.tif", surface, "lit.ply"));
    EXPECT_EQ(tree_times(), first); // it was read, not written
    EXPECT_NEAR(middle("three.tif", 1), middle("one.tif", 1), 1e-5);
  }
  EXPECT_EQ(pixels("two.tif"), pixels("one.tif"));
  render(lit_plate(1, "lit.ply", 3));
  render(option + look(1, "four.tif", "builtin", "lit.ply"));
  EXPECT_NEAR(middle("four.tif", 1), 3 * middle("one.tif", 1), 1e-3);
  EXPECT_NE(tree_times(), first);
  file("occupied", "no folder");
  file("a.rib", "Option \"subsurface\" \"string treefolder\" \"occupied\"\n" +
                    look(1, "five.tif", "builtin", "lit.ply"));
  const Outcome o = run("a.rib");
  EXPECT_THAT(o.text, HasSubstr("builtin.sl:4: subsurface: cannot write 'occupied/lit-"));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(pixels("five.tif"), pixels("four.tif"));
}

// Diffusion, single scattering and reflection as pictures of their own add up to the whole.
TEST_F(SubsurfacePasses, ComponentsAddUp) {
  auto look_at = [&](int number, const std::string& output, int diffuse, int single, int specular) {
    return frame(
        number, output, 0.5, 8,
        fmt::format(
            "{}Attribute \"visibility\" \"trace\" 1\nSurface \"translucentsolid\" \"cloud\" \"lit.ply\" "
            "\"color albedo\" [.8 .5 .2] \"color freepath\" [2 1 1] \"Kdiffuse\" {} \"Ksingle\" {} "
            "\"Kspecular\" {} \"samples\" 64\n{}",
            kSlantedLight, diffuse, single, specular, kPlate));
  };
  render(lit_plate(1, "lit.ply", 1) + look_at(2, "all.tif", 1, 1, 1) + look_at(3, "diffuse.tif", 1, 0, 0) +
         look_at(4, "single.tif", 0, 1, 0) + look_at(5, "specular.tif", 0, 0, 1));
  EXPECT_GT(mean("single.tif"), 0.001);
  EXPECT_GT(mean("diffuse.tif"), 0.1);
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(mean("all.tif", c), mean("diffuse.tif", c) + mean("single.tif", c) + mean("specular.tif", c),
                2e-4);
}

// A wall just above a translucent plate receives what comes out of it.
TEST_F(SubsurfacePasses, TranslucencyCountsWhenLightBleeds) {
  file("builtin.sl", kBuiltIn);
  file("wall.sl", "surface wall() { Oi = 1; Ci = indirectdiffuse(P, normalize(N), 64); }\n");
  render(lit_plate(1, "lit.ply", 1) + look(2, "plate.tif", "builtin", "lit.ply") +
         frame(3, "wall.tif", 0.2, 8,
               "Attribute \"visibility\" \"diffuse\" 1\nSurface \"builtin\" \"cloud\" \"lit.ply\"\n" +
                   std::string(kPlate) +
                   "Surface \"wall\"\nReverseOrientation\nPolygon \"P\" [-1 -1 -.05 -1 1 -.05 1 1 -.05 1 -1 "
                   "-.05]\n"));
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(mean("wall.tif", c), mean("plate.tif", c), 0.02 * mean("plate.tif", c));
}

TEST_F(SubsurfacePasses, AFileThatIsMissingIsNamedWithTheShadersLine) {
  file("a.rib",
       frame(1, "out.tif", 0.5, 8,
             std::string("Surface \"translucentsolid\" \"cloud\" \"none.ply\" \"material\" \"skin1\"\n") +
                 kPlate));
  const Outcome o = run("a.rib");
  EXPECT_THAT(o.text, HasSubstr("pointscattering.h:"));
  EXPECT_THAT(o.text, HasSubstr("subsurface.so: cannot open 'none.ply'"));
}

} // namespace
