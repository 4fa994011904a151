// When plug-ins are initialised and cleaned up; threads; what they ask of the program.
#include "tests/plugins/plugged.h"
#include "tests/temp_folder.h"

#include <cstdlib>
#include <thread>

namespace slvm::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The functions write lines to a file.
struct PluginLife : ::testing::Test {
  PluginLife() { ::setenv("LIFE_LOG", (folder / "log").c_str(), 1); }
  ~PluginLife() override { ::unsetenv("LIFE_LOG"); }
  std::string log() { return folder.has("log") ? folder.read("log") : ""; }
  anemone::test::TempFolder folder;
};

TEST_F(PluginLife, FunctionsByPointAreInitialisedOncePerThread) {
  Plugged p;
  auto surface = p.bind("surface s() { Ci = color(lf_first(xcomp(P)), lf_second(1), lf_other(2)); }");
  ASSERT_TRUE(surface);
  EXPECT_EQ(log(), ""); // not before the first call
  Grid grid = square(3, 1);
  {
    ShadingContext first(p.machine, p.services), second(p.machine, p.services);
    first.shade({.surface = surface.get()}, grid);
    EXPECT_EQ(log(), "init 0\nother init 0\n"); // one for both tables that name the same functions
    first.shade({.surface = surface.get()}, grid);
    EXPECT_EQ(log(), "init 0\nother init 0\n");
    EXPECT_THAT(red(grid, 0), Each(1.0f));
    EXPECT_THAT(red(grid, 1), Each(2.0f));
    EXPECT_THAT(red(grid, 2), Each(-3.0f)); // its init returns null
    second.shade({.surface = surface.get()}, grid);
    EXPECT_EQ(log(), "init 0\nother init 0\ninit 1\nother init 1\n");
  }
  const std::string end = "other shutdown 0\nshutdown 1\n"; // in the reverse order
  EXPECT_EQ(log(), "init 0\nother init 0\ninit 1\nother init 1\n" + end + end);
}

TEST_F(PluginLife, FunctionsByGridAreInitialisedOncePerFrame) {
  {
    Plugged p;
    Grid grid = square(3, 1);
    for (int frame = 0; frame < 2; ++frame) {
      auto surface = p.bind("surface s() { Ci = sv_visits(); }");
      auto again = p.bind("surface t() { Ci = sv_visits() + 1; }");
      ASSERT_TRUE(surface && again);
      ShadingContext first(p.machine, p.services), second(p.machine, p.services);
      first.shade({.surface = surface.get()}, grid);
      EXPECT_THAT(red(grid, 0), Each(1.0f)) << "storage of the grid";
      EXPECT_THAT(red(grid, 1), Each(1.0f)) << "storage of the thread";
      EXPECT_THAT(red(grid, 2), Each(1.0f)) << "storage of the frame";
      first.shade({.surface = surface.get()}, grid);
      EXPECT_THAT(red(grid, 0), Each(1.0f));
      EXPECT_THAT(red(grid, 1), Each(2.0f));
      EXPECT_THAT(red(grid, 2), Each(2.0f));
      second.shade({.surface = surface.get()}, grid);
      EXPECT_THAT(red(grid, 1), Each(1.0f));
      EXPECT_THAT(red(grid, 2), Each(3.0f));
      if (frame == 1) continue;
      first.~ShadingContext();
      new (&first) ShadingContext(p.machine, p.services);
      second.~ShadingContext();
      new (&second) ShadingContext(p.machine, p.services);
      EXPECT_EQ(p.machine.end_plugins(), "services: 1.500 s, time it took\n");
      EXPECT_EQ(p.machine.end_plugins(), "");
    }
  } // the second frame ends with the machine
  const std::string frame =
      "library init\nbegin\ninit\nend of grid\nend of grid\nend of grid\nend of thread\nend of thread\n"
      "end of frame\ncleanup\nend\nlibrary cleanup\n";
  EXPECT_EQ(log(), frame + frame);
}

TEST_F(PluginLife, InstancesOfAnEarlierFrameGoOn) {
  Plugged p;
  auto surface = p.bind("surface s() { Ci = sv_visits(); }");
  ASSERT_TRUE(surface);
  p.machine.end_plugins();
  Grid grid = square(2, 1);
  ShadingContext context(p.machine, p.services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid, 2), Each(1.0f));
  EXPECT_EQ(
      log(),
      "library init\nbegin\ninit\ncleanup\nend\nlibrary cleanup\nlibrary init\nbegin\ninit\nend of grid\n");
}

// Shades the same in several threads at once; what they got, added up.
float in_threads(Plugged& p, const std::string& statements, int threads, int rounds) {
  auto surface = p.bind("surface s() { " + statements + " }");
  std::vector<float> totals(static_cast<size_t>(threads));
  std::vector<std::thread> running;
  for (int t = 0; t < threads; ++t)
    running.emplace_back([&, t] {
      TableServices services;
      ShadingContext context(p.machine, services);
      Grid grid = square(8, 1);
      for (int i = 0; i < rounds; ++i) {
        context.shade({.surface = surface.get()}, grid);
        for (float x : red(grid))
          totals[static_cast<size_t>(t)] += x;
      }
    });
  for (std::thread& thread : running)
    thread.join();
  float total = 0;
  for (float x : totals)
    total += x;
  return total;
}

TEST_F(PluginLife, FunctionsByPointTakeTurns) {
  Plugged p;
  EXPECT_EQ(in_threads(p, "Ci = lf_alone(xcomp(P));", 4, 10), 0);
}

TEST_F(PluginLife, UnlessTheySayThatTheyNeedNot) {
  Plugged p;
  EXPECT_EQ(in_threads(p, "Ci = lf_together(1);", 2, 1), 16); // each waits for the other
}

TEST_F(PluginLife, DataOfThreadsIsApart) {
  Plugged p;
  // 1..8 in each thread's first grid, 9..16 in the second.
  EXPECT_EQ(in_threads(p, "Ci = pt_count(xcomp(P));", 3, 2), 3 * 16 * 17 / 2);
}

TEST_F(PluginLife, MessagesNameTheLine) {
  Plugged p;
  auto surface = p.bind("surface s() {\n  if (xcomp(P) > 0.4)\n    sv_tell();\n}");
  ASSERT_TRUE(surface);
  Grid grid = square(4, 1);
  ShadingContext context(p.machine, p.services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(p.messages(),
              ElementsAre("3: services.so: 3 crumbs (2)", "3: services.so: no cheese left (2)"));
  EXPECT_EQ(p.services.printed, "services.so: a good year\n");
}

TEST_F(PluginLife, NoiseSpacesAndAttributes) {
  Plugged p;
  Matrix4 mine; // twice as large as "current"
  mine.m[0] = 2;
  p.services.spaces["mine"] = mine;
  p.services.attributes["user:size"] = {Type::kFloat, 0, {4}, {}};
  const char* source = "Ci = sv_ask(P) - color(noise(P), 0, 0);";
  EXPECT_THAT(p.shade(source, 3, 0), Each(0.0f));
  EXPECT_THAT(p.shade(source, 3, 1), ElementsAre(0, 0.25f, 0.5f));
  EXPECT_THAT(p.shade(source, 3, 2), Each(5.0f));
  EXPECT_THAT(p.messages(), IsEmpty());
}

/// Maps whose values tell what was asked.
class ToldMaps : public TextureServices {
public:
  std::string texture(const TextureLookup& l) override { return tell(l, 1000); }
  std::string environment(const TextureLookup& l) override { return tell(l, 2000); }
  std::string shadow(const TextureLookup& l) override { return tell(l, 3000); }
  bool info(std::string_view map, std::string_view field, const Matrix4&, Value& out) override {
    out = {Type::kFloat, 2, {640, 480}, {}};
    return map == "map" && field == "resolution";
  }

private:
  // Channel, then what there is of: middle, sides, blur or bias, filter.
  static std::string tell(const TextureLookup& l, float kind) {
    if (l.map != "map") return "it is missing";
    for (size_t i = 0; i < l.points; ++i) {
      EXPECT_TRUE(l.active(i));
      const float sides = 100 * l.along_u[0][i] + 10 * l.along_v[1][i];
      for (uint32_t c = 0; c < l.channels; ++c)
        l.result[c][i] = kind + sides + l.centre[0][i] + TextureLookup::at(l.sblur, i) +
                         TextureLookup::at(l.bias, i) + (l.options.filter == "box" ? 0.25f : 0) +
                         0.01f * static_cast<float>(l.first_channel + c);
    }
    return "";
  }
};

struct WithMaps : TableServices {
  ToldMaps maps;
  TextureServices* textures() override { return &maps; }
};

struct PluginMaps : ::testing::Test, Plugged {
  /// sv_maps, or another function like it, at x = 0 and x = 1.
  std::vector<float> ask(const std::string& what, const std::string& map, size_t component,
                         const std::string& function = "sv_maps") {
    auto surface = bind("surface s() { Ci = " + function + "(P, \"" + what + "\", \"" + map + "\"); }");
    Grid grid = square(2, 1);
    ShadingContext context(machine, services_with_maps);
    if (surface) context.shade({.surface = surface.get()}, grid);
    return red(grid, component);
  }
  WithMaps services_with_maps;
};

TEST_F(PluginMaps, LookupsOfEachKind) {
  using ::testing::FloatEq;
  auto expect = [&](const char* what, size_t component, float at_0) {
    EXPECT_THAT(ask(what, "map", component), ElementsAre(FloatEq(at_0), FloatEq(at_0 + 1)))
        << what << component;
  };
  // Twice as wide; the middle is half to the right; five channels from 2 on.
  expect("texture", 0, 1000 + 200 + 60 + 0.5f + 0.25f + 0.02f);
  expect("texture", 2, 1000 + 200 + 60 + 0.5f + 0.25f + 0.06f);
  expect("environment", 1, 2000 + 100 + 20 + 0.5f + 0.01f);
  expect("environmentV", 2, 2000 + 100 + 20 + 0.5f + 0.5f + 0.03f);
  expect("shadow", 0, 3000 + 100 + 20 + 0.5f + 0.5f);
  expect("shadowV", 0, 3000 + 100 + 20 + 0.5f + 0.5f);
  EXPECT_THAT(messages(), IsEmpty());
  expect("textureV", 0, 1000 + 100 + 30 + 0.5f + 0.5f); // corners in turn
  EXPECT_THAT(messages(), ElementsAre("1: RxTexture of a plug-in: \"cheese\" has no effect (2)"));
  EXPECT_THAT(ask("info", "map", 0), Each(640.0f));
  EXPECT_THAT(ask("info", "map", 1), Each(480.0f));
  EXPECT_THAT(ask("info", "map", 2), Each(2.0f));
}

TEST_F(PluginMaps, LookupsOfManyPointsAtOnce) {
  using ::testing::FloatEq;
  auto expect = [&](const char* what, size_t component, float at_0) {
    EXPECT_THAT(ask(what, "map", component, "sv_many"), ElementsAre(FloatEq(at_0), FloatEq(at_0 + 1)))
        << what << component;
  };
  expect("texture", 0, 1000 + 100 + 30 + 0.5f + 0.5f + 0.02f);
  expect("texture", 2, 1000 + 100 + 30 + 0.5f + 0.5f + 0.06f);
  expect("textureV", 1, 1000 + 100 + 30 + 0.5f + 0.5f + 0.01f);
  expect("environment", 2, 2000 + 100 + 20 + 0.5f + 0.02f);
  expect("environmentV", 0, 2000 + 100 + 20 + 0.5f + 0.5f + 0.01f);
  expect("shadow", 0, 3000 + 100 + 20 + 0.5f);
  expect("shadowV", 0, 3000 + 100 + 20 + 0.5f + 0.5f);
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_THAT(ask("shadow", "none", 0, "sv_many"), Each(-1.0f));
  EXPECT_THAT(messages(), ElementsAre("1: RxShadowPoints of a plug-in, \"none\": it is missing (1)"));
}

TEST_F(PluginMaps, WhereTheCallIs) {
  EXPECT_THAT(shade("\n\nCi = sv_where();", 1, 0), Each(0.0f));
  EXPECT_THAT(shade("\n\nCi = sv_where();", 1, 1), Each(3.0f));
  EXPECT_THAT(shade("\n\nCi = sv_where();", 1, 2), Each(1.0f));
}

TEST_F(PluginMaps, MapsThatAreMissing) {
  EXPECT_THAT(ask("texture", "none", 0), Each(-1.0f));
  EXPECT_THAT(ask("texture", "none", 1), Each(0.0f));
  EXPECT_THAT(ask("info", "none", 0), Each(-1.0f));
  EXPECT_THAT(ask("shadow", "", 0), Each(-1.0f));
  EXPECT_THAT(messages(), ElementsAre("1: RxTexture of a plug-in, \"none\": it is missing (4)"));
  EXPECT_THAT(shade("Ci = sv_maps(P, \"environment\", \"map\");", 1), Each(-1.0f));
  EXPECT_THAT(messages().back() + messages().front(), HasSubstr("there are no textures here"));
}

} // namespace
} // namespace slvm::test
