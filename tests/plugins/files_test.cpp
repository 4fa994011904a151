// Plug-ins and files: points that they write and find again, whole maps.
#include "stdlib/scattering/baked_clouds.h"
#include "tests/plugins/plugged.h"
#include "tests/temp_folder.h"

namespace slvm::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

/// A map of three channels, 3 x 2 and 1 x 1 texels: number 100 level + 10 texel + channel.
class WholeMaps : public TextureServices {
public:
  std::string texture(const TextureLookup&) override { return "none here"; }
  std::string environment(const TextureLookup&) override { return "none here"; }
  std::string shadow(const TextureLookup&) override { return "none here"; }
  bool info(std::string_view, std::string_view, const Matrix4&, Value&) override { return false; }
  std::string texels(std::string_view map, size_t level, TextureTexels& out) override {
    if (map != "map") return "it is missing";
    if (level > 1) return "it has the levels 0 and 1";
    out = {level ? 1u : 3u, level ? 1u : 2u, 3, {}};
    for (size_t i = 0; i < out.width * out.height; ++i)
      for (size_t c = 0; c < 3; ++c)
        out.values.push_back(static_cast<float>(100 * level + 10 * i + c));
    return {};
  }
};

class PluginFiles : public ::testing::Test, public Plugged {
protected:
  struct Services : TableServices {
    TextureServices* textures() override { return &maps; }
    PointCloudServices* point_clouds() override { return &clouds; }
    WholeMaps maps;
    subsurface::BakedClouds clouds;
  };
  PluginFiles() {
    with_files.spaces["world"] = Matrix4();
    Matrix4 mine; // its unit is two of the others, so that lengths are halves
    mine(0, 0) = mine(1, 1) = mine(2, 2) = 2;
    with_files.spaces["mine"] = mine;
    Value five{Type::kFloat, 0, {5}, {}};
    five.integers = true;
    with_files.attributes["user:five"] = five;
    with_files.attributes["user:number"] = {Type::kFloat, 0, {5}, {}};
  }
  std::vector<float> ask(const std::string& statements, size_t component, int n = 3) {
    auto surface = bind("surface s() { " + statements + " }");
    Grid grid = square(n, 1);
    ShadingContext context(machine, with_files);
    if (surface) context.shade({.surface = surface.get()}, grid);
    return red(grid, component);
  }
  std::string path(const char* name) const { return '"' + (folder / name).string() + '"'; }

  anemone::test::TempFolder folder;
  Services with_files;
};

// x is 0, 0.5 and 1 on a grid of three points.
TEST_F(PluginFiles, PointsAreWrittenAndFoundAgain) {
  EXPECT_THAT(ask("Ci = fl_bake(P, N, " + path("a.ply") + ");", 0), Each(0.0f));
  EXPECT_THAT(with_files.clouds.finish(), IsEmpty());
  auto cloud = subsurface::read_point_cloud((folder / "a.ply").string());
  ASSERT_TRUE(cloud) << cloud.error();
  ASSERT_EQ(cloud->size(), 3u);
  EXPECT_THAT(cloud->area, Each(FloatNear(3.14159265f / 4, 1e-6f)));
  ASSERT_NE(cloud->find("tint_g"), nullptr);
  EXPECT_THAT(cloud->find("heat")->values, ElementsAre(0.0f, 0.5f, 1.0f));
  const std::string read = "Ci = fl_read(P, N, " + path("a.ply") + ", ";
  EXPECT_THAT(ask(read + "0.3);", 0), Each(0.0f));
  EXPECT_THAT(ask(read + "0.3);", 1), ElementsAre(0.0f, 0.5f, 1.0f)); // each within its own reach
  // Weights 1 - d^2/r^2 of the neighbours at distances of a half: 1 - 0.25/1 = 0.75; the far one has none.
  EXPECT_THAT(ask(read + "1);", 1),
              ElementsAre(FloatEq(0.375f / 1.75f), FloatEq(0.5f), FloatEq(1.375f / 1.75f)));
  // All three are the nearest ones, the farthest a tenth within the edge.
  EXPECT_THAT(ask(read + "0);", 1)[1], FloatEq(0.5f));
  EXPECT_THAT(ask(read + "6);", 2), Each(-1.0f)); // only "heat" was asked for
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(PluginFiles, WhatIsFarOrFacesAwayIsNotFound) {
  ask("Ci = fl_bake(P, N, " + path("a.ply") + ");", 0);
  with_files.clouds.finish();
  const std::string far = "Ci = fl_read(P + vector (0, 0, 9), N, " + path("a.ply") + ", 1);",
                    away = "Ci = fl_read(P, -N, " + path("a.ply") + ", 1);";
  for (const std::string& statements : {far, away}) {
    EXPECT_THAT(ask(statements, 0), Each(-1.0f));
    EXPECT_THAT(ask(statements, 1), Each(-1.0f)); // as it was
  }
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(PluginFiles, SpacesOfPoints) {
  ask("Ci = fl_bake(P, N, " + path("mine.ply") + ");", 0);
  with_files.clouds.finish();
  auto cloud = subsurface::read_point_cloud((folder / "mine.ply").string());
  ASSERT_TRUE(cloud) << cloud.error();
  EXPECT_FLOAT_EQ(cloud->position[2].x, 0.5f);
  EXPECT_THAT(cloud->area, Each(FloatNear(3.14159265f / 16, 1e-6f)));
  EXPECT_THAT(cloud->find("heat")->values, ElementsAre(0.0f, 0.5f, 1.0f)); // values are as they are
}

TEST_F(PluginFiles, WhatIsWrongWithFilesOfPoints) {
  EXPECT_THAT(ask("Ci = fl_read(P, N, \"none.ply\", 1);", 0), Each(-1.0f));
  EXPECT_THAT(messages(), ElementsAre(AllOf(HasSubstr("1: RxTexture3d of a plug-in, \"none.ply\": "),
                                            HasSubstr("none.ply"))));
  ask("Ci = fl_bake(P, N, " + path("a.ply") + ");", 0);
  with_files.clouds.finish();
  EXPECT_THAT(ask("Ci = fl_wrong(" + path("a.ply") + ", \"float cold\");", 0), Each(-1.0f));
  EXPECT_THAT(messages(), Contains(HasSubstr("a.ply\": it has no channel \"float cold\"")));
  EXPECT_THAT(ask("Ci = fl_wrong(" + path("a.ply") + ", \"heat\");", 0), Each(-1.0f));
  EXPECT_THAT(messages(),
              Contains(HasSubstr(
                  "\"heat\" needs a type in front of its name: float, color, point, vector or normal")));
  // Two kinds of points in one file.
  CloudPoints other;
  const std::string file = (folder / "b.ply").string();
  other.file = file;
  for (auto* numbers : {&other.position[0], &other.position[1], &other.position[2], &other.normal[0],
                        &other.normal[1], &other.normal[2], &other.radius})
    numbers->push_back(1);
  EXPECT_EQ(with_files.clouds.bake(other), "");
  EXPECT_THAT(ask("Ci = fl_bake(P, N, \"" + file + "\");", 0), Each(-1.0f));
  EXPECT_THAT(messages(), Contains(AllOf(HasSubstr("RxBake3d of a plug-in"),
                                         HasSubstr("a file has the same at all its points (3)"))));
  // A file that cannot be written.
  ask("Ci = fl_bake(P, N, \"/none/a.ply\");", 0);
  EXPECT_THAT(with_files.clouds.finish(), ElementsAre(HasSubstr("/none/a.ply")));
  // A program without such files.
  EXPECT_THAT(shade("Ci = fl_bake(P, N, \"a.ply\");", 1), Each(-1.0f));
  EXPECT_THAT(messages(), Contains(HasSubstr("this program has no files of points")));
}

TEST_F(PluginFiles, WholeMaps) {
  EXPECT_THAT(ask("Ci = fl_texels(\"map\", 0, 0, 2);", 0), Each(0.0f));
  EXPECT_THAT(ask("Ci = fl_texels(\"map\", 0, 0, 2);", 1), Each(2.0f));
  EXPECT_THAT(ask("Ci = fl_texels(\"map\", 0, 0, 2);", 2), Each(50.0f)); // channel 0 of the sixth texel
  EXPECT_THAT(ask("Ci = fl_texels(\"map\", 1, 0, 1);", 1), Each(101.0f));
  EXPECT_THAT(messages(), IsEmpty());
  auto complains = [&](const std::string& call, const char* text) {
    EXPECT_THAT(ask("Ci = " + call + ";", 0), Each(-1.0f)) << call;
    EXPECT_THAT(messages(), Contains(HasSubstr(text)));
  };
  complains("fl_texels(\"map\", 0, 1, 2)", "\"map\": it has one face, number 0, and no face 1");
  complains("fl_texels(\"map\", 0, 0, 3)", "\"map\": it has 3 channels, and no channel 3");
  complains("fl_texels(\"map\", 2, 0, 0)", "\"map\": it has the levels 0 and 1");
  complains("fl_texels(\"cheese\", 0, 0, 0)", "RxTextureGetData of a plug-in, \"cheese\": it is missing");
}

TEST_F(PluginFiles, ShadowsOfSourcesSayWhatToDo) {
  EXPECT_THAT(ask("Ci = fl_source();", 0), Each(-1.0f));
  EXPECT_THAT(ask("Ci = fl_source();", 1), Each(0.0f));
  EXPECT_THAT(messages(),
              ElementsAre("1: RxSourceShadow of a plug-in is not there: shadow maps have one depth a pixel; "
                          "RxShadow with a \"blur\" as wide as the light softens their edges (2)"));
}

TEST_F(PluginFiles, NamesThatNobodyElseHas) {
  auto surface = bind("surface s() { printf(\"%s %s\", fl_unique(), fl_unique()); }");
  Grid grid = square(1, 1);
  ShadingContext context(machine, with_files);
  context.shade({.surface = surface.get()}, grid);
  const std::string one = with_files.printed.substr(0, 36), other = with_files.printed.substr(37);
  const char* kForm = "[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}";
  EXPECT_THAT(one, MatchesRegex(kForm));
  EXPECT_THAT(other, MatchesRegex(kForm));
  EXPECT_NE(one, other);
}

TEST_F(PluginFiles, WholeNumbersOfScenes) {
  auto numbers = [&](const char* name) {
    const std::string call = std::string("Ci = fl_integer(\"user:") + name + "\");";
    return std::vector{ask(call, 0, 1)[0], ask(call, 1, 1)[0], ask(call, 2, 1)[0]};
  };
  EXPECT_THAT(numbers("five"), ElementsAre(0.0f, 1.0f, 5.0f));
  EXPECT_EQ(numbers("number")[1], 0.0f);
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(PluginFiles, ResultsOfFunctionsThatHaveNone) {
  EXPECT_THAT(ask("fl_text(\"x\"); Ci = 3;", 0), Each(3.0f));
  EXPECT_THAT(messages(), IsEmpty());
}

// Without `output` in the prototype of a function that gives nothing back, it stores to variables of the
// shader's own.
TEST_F(PluginFiles, DialectWithoutOutput) {
  EXPECT_THAT(ask("float y = 7; fl_twice(u, y); Ci = y;", 0), ElementsAre(0.0f, 1.0f, 2.0f));
  EXPECT_THAT(ask("fl_twice(u, 3); Ci = u;", 0), ElementsAre(0.0f, 0.5f, 1.0f));
}

// A library that is named makes its functions known beside the built-in ones of their name.
TEST_F(PluginFiles, OverloadsOfBuiltInFunctions) {
  EXPECT_TRUE(compile("surface s() { Ci = erfc(point (2, 0, 0)); }").empty());
  EXPECT_THAT(diagnostics, HasSubstr("no 'erfc' takes (point)"));
  auto surface = bind("plugin \"builtin_name\"; surface s() { Ci = erfc(point (2, 0, 0)) + erfc(0); }");
  Grid grid = square(1, 1);
  ShadingContext context(machine, with_files);
  ASSERT_TRUE(surface);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid, 0), Each(FloatEq(103.0f)));
}

} // namespace
} // namespace slvm::test
