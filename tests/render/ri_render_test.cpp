// The C interface rendering in process: the same pictures as by way of a file, functions that make geometry,
// what only a renderer can answer.
#include "render/renderer.h"
#include "tests/render/ri_testing.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <filesystem>
#include <numeric>

namespace render::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<float> pixels(const std::string& name) {
  auto in = OIIO::ImageInput::open(name);
  if (!in) return {};
  const OIIO::ImageSpec& s = in->spec();
  std::vector<float> out(static_cast<size_t>(s.width * s.height * s.nchannels));
  in->read_image(0, 0, 0, s.nchannels, OIIO::TypeDesc::FLOAT, out.data());
  return out;
}

class RiRender : public RiTest {
protected:
  void display(const std::string& name) {
    std::string path = folder_ / name;
    RiDisplay(path.c_str(), "openexr", RI_RGBA, RI_NULL);
  }
  std::vector<float> picture(const std::string& name) { return pixels(folder_ / name); }
  /// A camera at distance 4 with a field of view of 90 degrees, 100 x 100 pixels.
  void camera(const std::string& name) {
    RtFloat fov = 90;
    display(name);
    RiFormat(100, 100, 1);
    RiPixelSamples(8, 8);
    RiPixelFilter(RiBoxFilter, 1, 1);
    RiProjection(RI_PERSPECTIVE, RI_FOV, &fov, RI_NULL);
    RiTranslate(0, 0, 4);
  }
  /// Sum of alpha: the pixels that are covered.
  double covered(const std::string& name) {
    std::vector<float> p = picture(name);
    double sum = 0;
    for (size_t i = 3; i < p.size(); i += 4)
      sum += static_cast<double>(p[i]);
    return sum;
  }
};

/// Some of everything: declared and inline variables, objects, motion, curves, lights.
void scene() {
  RtFloat kd = 0.5f, heat[4] = {0, 1, 0.5f, 1}, width[6] = {0.1f, 0.2f, 0.1f, 0.1f, 0.2f, 0.1f};
  RtPoint square[4] = {{-1, -1, 1}, {-1, 1, 1}, {1.3f, 1, 1}, {1.3f, -1, 1}};
  RtColor colors[4] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, blue = {0.1f, 0.2f, 0.9f};
  RtPoint hair[6] = {{-2, -1, 0}, {0, 0.3f, 0}, {2, -1, 0}, {-2, 1, 0}, {0, -0.3f, 0.5f}, {2, 1, 0}};
  RtInt n[2] = {3, 3}, gridsize = 64;
  RiOption("limits", "gridsize", &gridsize, RI_NULL);
  RiShutter(0, 1);
  RiWorldBegin();
  RtLightHandle light = RiLightSource("distantlight", RI_NULL);
  RiLightSource("ambientlight", "intensity", &kd, RI_NULL);
  RiAttributeBegin();
  RiSurface("matte", RI_KD, &kd, RI_NULL);
  RiDeclare("heat", "varying float");
  RiPolygon(4, RI_P, square, RI_CS, colors, "heat", heat, RI_NULL);
  RiAttributeEnd();
  RtObjectHandle ball = RiObjectBegin();
  RiSphere(0.4f, -0.4f, 0.4f, 360, RI_NULL);
  RiObjectEnd();
  RiAttributeBegin();
  RiColor(blue);
  RiMotionBegin(2, 0.0, 1.0);
  RiTranslate(-0.7f, 0.3f, 0);
  RiTranslate(-0.5f, 0.4f, 0);
  RiMotionEnd();
  RiSurface("plastic", RI_NULL);
  RiObjectInstance(ball);
  RiAttributeEnd();
  RiIlluminate(light, RI_FALSE);
  RiCurves(RI_LINEAR, 2, n, RI_NONPERIODIC, RI_P, hair, RI_WIDTH, width, RI_NULL);
  RiTranslate(0.5f, -0.4f, 0);
  RiRotate(-70, 1, 0, 0);
  RiScale(0.2f, 0.2f, 0.2f);
  RiGeometry("teapot", RI_NULL);
  RiWorldEnd();
}

TEST_F(RiRender, a_file_in_between_changes_nothing) {
  RiBegin(RI_NULL);
  camera("direct.exr");
  scene();
  RiEnd();
  std::vector<float> direct = picture("direct.exr");
  ASSERT_EQ(direct.size(), 40000u);
  EXPECT_GT(covered("direct.exr"), 500);
  for (const char* format : {"ascii", "binary"}) {
    begin_file();
    RiOption("rib", "format", &format, RI_NULL);
    camera("again.exr");
    scene();
    end_file();
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    RendererSettings settings;
    settings.shader_loader = [](const std::string& name, const std::vector<std::string>&) {
      return load_compiled_shader(name, {SHADER_FOLDER});
    };
    Renderer renderer(sources, diagnostics, settings);
    ASSERT_TRUE(renderer.read_file(folder_ / "t.rib"));
    EXPECT_EQ(format_diagnostics(diagnostics, sources), "");
    EXPECT_EQ(picture("again.exr"), direct) << format;
  }
  EXPECT_THAT(told(), IsEmpty());
}

/// What a procedural was told.
struct Called {
  std::vector<RtFloat> details;
  int freed = 0;
};

void draw(RtPointer data, RtFloat detail) {
  static_cast<Called*>(data)->details.push_back(detail);
  RiSphere(0.5f, -0.5f, 0.5f, 360, RI_NULL);
}
void release(RtPointer data) {
  ++static_cast<Called*>(data)->freed;
}

TEST_F(RiRender, functions_are_called_for_what_is_seen) {
  Called seen, unseen, nested;
  RtBound bound = {-1, 1, -1, 1, -1, 1};
  RiBegin(RI_NULL);
  camera("a.exr");
  RiWorldBegin();
  RiSides(1);
  RiProcedural(&seen, bound, draw, release);
  RiTranslate(100, 0, 0);
  RiProcedural(&unseen, bound, draw, release);
  EXPECT_TRUE(seen.details.empty()) << "not before the end of the world";
  RiWorldEnd();
  RiEnd();
  // The near face of the bound lies at 3, where the picture is 6 wide.
  ASSERT_EQ(seen.details.size(), 1u);
  EXPECT_NEAR(seen.details[0], 100 * 100 / 9.0f, 0.01f);
  EXPECT_EQ(seen.freed, 1);
  EXPECT_TRUE(unseen.details.empty());
  EXPECT_EQ(unseen.freed, 1);
  double radius = 50 * std::tan(std::asin(0.5 / 4));
  EXPECT_NEAR(covered("a.exr"), 3.14159265 * radius * radius, 4); // the outline is made of straight edges
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRender, functions_divide_by_detail) {
  // A square of squares, halved until each covers less than 100 pixels: 10000 / 4^4 is the first.
  struct Square {
    static void divide(RtPointer data, RtFloat detail) {
      auto* s = static_cast<RtFloat*>(data);
      if (detail < 100) {
        RtPoint P[4] = {
            {s[0], s[1], 0}, {s[0], s[1] + s[2], 0}, {s[0] + s[2], s[1] + s[2], 0}, {s[0] + s[2], s[1], 0}};
        RiPolygon(4, RI_P, P, RI_NULL);
        ++leaves();
        return;
      }
      RtFloat h = s[2] / 2;
      for (int i = 0; i < 4; ++i)
        make(s[0] + h * static_cast<RtFloat>(i % 2), s[1] + h * static_cast<RtFloat>(i / 2), h);
    }
    static void make(RtFloat x, RtFloat y, RtFloat size) {
      auto* data = static_cast<RtFloat*>(std::malloc(3 * sizeof(RtFloat)));
      data[0] = x, data[1] = y, data[2] = size;
      RtBound bound = {x, x + size, y, y + size, 0, 0};
      RiProcedural(data, bound, divide, RiProcFree);
    }
    static int& leaves() {
      static int n = 0;
      return n;
    }
  };
  RiBegin(RI_NULL);
  camera("a.exr");
  RiWorldBegin();
  Square::make(-4, -4, 8);
  RiWorldEnd();
  RiEnd();
  EXPECT_EQ(Square::leaves(), 256);
  EXPECT_NEAR(covered("a.exr"), 10000, 1);
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(RiRender, points_go_from_space_to_space) {
  RiBegin(RI_NULL);
  camera("a.exr");
  RiCoordinateSystem("eyes");
  RiWorldBegin();
  RiTranslate(1, 0, 0);
  RtPoint p[2] = {{0, 0, 0}, {1, 2, 4}}, q[1] = {{1, 1, 0}};
  EXPECT_EQ(RiTransformPoints("object", "camera", 2, p), p);
  EXPECT_THAT(std::vector(p[1], p[1] + 3), ElementsAre(2, 2, 8));
  EXPECT_EQ(RiTransformPoints("world", "raster", 1, q), q);
  EXPECT_NEAR(q[0][0], 50 + 12.5f, 1e-3f);
  EXPECT_NEAR(q[0][1], 50 - 12.5f, 1e-3f);
  EXPECT_EQ(RiTransformPoints("camera", "eyes", 1, q), q);
  EXPECT_NEAR(q[0][0], 62.5f, 1e-3f);
  EXPECT_EQ(RiTransformPoints("nowhere", "camera", 1, q), nullptr);
  EXPECT_THAT(told(), ElementsAre("41 2: RiTransformPoints: no coordinate system is named \"nowhere\""));
}

TEST_F(RiRender, filters_are_functions) {
  EXPECT_FLOAT_EQ(RiBoxFilter(0.4f, 0.2f, 1, 1), 1);
  EXPECT_FLOAT_EQ(RiTriangleFilter(0.5f, 0, 2, 2), 0.5f);
  EXPECT_NEAR(RiGaussianFilter(1, 0, 4, 4), std::exp(-0.5), 1e-6);
  EXPECT_NEAR(RiCatmullRomFilter(1.5f, 0, 4, 4), -0.5 * 3.375 + 2.5 * 2.25 - 6 + 2, 1e-6);
  EXPECT_NEAR(RiSincFilter(1, 1, 4, 4), std::sin(1.0) * std::sin(1.0), 1e-6);
  auto render = [&](const std::string& name, RtFilterFunc filter) {
    RiBegin(RI_NULL);
    camera(name);
    RiPixelFilter(filter, 2, 2);
    RiWorldBegin();
    RiSphere(1, -1, 1, 360, RI_NULL);
    RiWorldEnd();
    RiEnd();
    return picture(name);
  };
  std::vector<float> ours = render("a.exr", RiGaussianFilter);
  std::vector<float> own = render("b.exr", [](RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    return std::exp(-2 * (4 * x * x / (xwidth * xwidth) + 4 * y * y / (ywidth * ywidth)));
  });
  ASSERT_EQ(own.size(), ours.size());
  float most = 0;
  for (size_t i = 0; i < own.size(); ++i)
    most = std::max(most, std::abs(own[i] - ours[i]));
  EXPECT_LT(most, 0.02f); // ours is tabulated
  EXPECT_NE(own, render("c.exr", RiBoxFilter));
  EXPECT_THAT(told(), IsEmpty());
  RiBegin(RI_NULL);
  RiPixelFilter([](RtFloat, RtFloat, RtFloat, RtFloat) -> RtFloat { return 1; }, 0, 1);
  EXPECT_THAT(told(), ElementsAre(HasSubstr("expected widths above 0")));
}

std::vector<std::string>& heard() {
  static std::vector<std::string> list;
  return list;
}

void listen(RtToken type, char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  EXPECT_STREQ(format, "%s");
  heard().push_back(std::string(type) + ":" + va_arg(arguments, char*));
  va_end(arguments);
}

TEST_F(RiRender, archives_are_read_with_their_comments) {
  folder_.write(
      "a.rib",
      "##RenderMan RIB\n# a ball\nDeclare \"heat\" \"varying float\" Basis \"b-spline\" 1 \"b-spline\" 1\n"
      "Sphere 1 -1 1 360 # at last");
  std::string name = folder_ / "a.rib";
  heard().clear();
  RiBegin(RI_NULL);
  camera("a.exr");
  RiWorldBegin();
  RiReadArchive(name.c_str(), listen, RI_NULL);
  EXPECT_THAT(heard(), ElementsAre("structure:RenderMan RIB", "comment: a ball", "comment: at last"));
  RiReadArchive(name.c_str(), RI_NULL, RI_NULL);
  EXPECT_EQ(heard().size(), 3u);
  // What it declared, and its basis, count from here on: 5 values for 4 segments.
  RtPoint hair[7] = {};
  RtFloat heat[5] = {};
  RtInt n[1] = {7};
  RiCurves(RI_CUBIC, 1, n, RI_NONPERIODIC, RI_P, hair, "heat", heat, RI_NULL);
  RiArchiveRecord(RI_VERBATIM, "Color 1 0 0 Sphere %g -1 1 360 Spher 1", 1.0);
  RiReadArchive("gone.rib", RI_NULL, RI_NULL);
  RiWorldEnd();
  RiEnd();
  EXPECT_THAT(told(),
              ElementsAre(HasSubstr("1: <RiArchiveRecord>:1:31: unknown request Spher; did you mean Sphere?"),
                          HasSubstr("3 2: ReadArchive: no archive \"gone.rib\" in the search path")));
}

TEST_F(RiRender, programs_run_when_the_program_says_so_but_not_archives) {
  folder_.write("maker",
                "#!/bin/sh\nwhile read line; do echo 'Sphere .5 -.5 .5 360'; printf '\\377'; done\n");
  std::filesystem::permissions(folder_ / "maker", std::filesystem::perms::owner_all);
  std::string maker = folder_ / "maker", archive = folder_ / "a.rib";
  folder_.write("a.rib", "Procedural \"RunProgram\" [\"" + maker + "\" \"\"] [-1 1 -1 1 -1 1]");
  RtBound bound = {-1, 1, -1, 1, -1, 1};
  RtString command[2] = {maker.c_str(), ""};
  RiBegin(RI_NULL);
  camera("a.exr");
  RiWorldBegin();
  RiReadArchive(archive.c_str(), RI_NULL, RI_NULL);
  RiWorldEnd();
  EXPECT_THAT(told(), ElementsAre(HasSubstr("scenes may run programs only with --allow-programs")));
  EXPECT_EQ(covered("a.exr"), 0);
  RiEnd();
  told().clear();
  RiBegin(RI_NULL);
  camera("a.exr");
  RiWorldBegin();
  RiProcedural(command, bound, RiProcRunProgram, RI_NULL);
  RiWorldEnd();
  RiEnd();
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_GT(covered("a.exr"), 100);
}

TEST_F(RiRender, plug_ins_call_back) {
  std::filesystem::copy_file(std::string(PLUG_INS) + "/balls.so", folder_ / "balls.so");
  std::string parameters = "0.5 " + (folder_ / "note").string();
  RtBound bound = {-1, 1, -1, 1, -1, 1};
  RtString plug_in[2] = {"balls", parameters.c_str()};
  for (bool allowed : {false, true}) {
    if (allowed) ::setenv("ANEMONE_PROCEDURALS", folder_.string().c_str(), 1);
    told().clear();
    RiBegin(RI_NULL);
    camera("a.exr");
    RiWorldBegin();
    RiProcedural(plug_in, bound, RiProcDynamicLoad, RI_NULL);
    RiWorldEnd();
    RiEnd();
    EXPECT_EQ(told().empty(), allowed);
    EXPECT_EQ(covered("a.exr") > 100, allowed);
  }
  ::unsetenv("ANEMONE_PROCEDURALS");
  EXPECT_EQ(folder_.read("note"), "converted 0.50\ndetail 1111.11\nfreed 0.00\n");
}

} // namespace
} // namespace render::testing
