// Observers: what they are told, that they change nothing, and the profiler.
#include "tests/unit/exec/shading.h"

#include "slvm/exec/profiler.h"

#include <gmock/gmock.h>

namespace slvm {
namespace {

using namespace test;
using ::testing::Each;
using ::testing::ElementsAre;

/// Calls of one function: points that were active, and the first number each stored.
struct Watcher : ExecutionObserver {
  explicit Watcher(std::string_view n) : name(n) {}
  bool before(const ExecutionStep& step) override {
    return !leave_out || !step.call() || step.call()->name != name;
  }
  void after(const ExecutionStep& step) override {
    if (!step.call() || step.call()->name != name) return;
    points += step.active_points();
    lines.push_back(step.place().line);
    for (const StepOperand& o : step.operands())
      if (!o.variable.empty()) variables.emplace_back(o.variable);
  }
  void begin_run(const Instance& i) override { shaders.push_back(i.shader().name()); }

  std::string_view name;
  bool leave_out = false;
  size_t points = 0;
  std::vector<uint32_t> lines;
  std::vector<std::string> variables, shaders;
};

constexpr const char* kSource = "surface s() {\n"
                                "  float x = 0;\n"
                                "  if (u > 0.4)\n"
                                "    x = sqrt(v);\n"
                                "  printf(\"%g\", 3);\n"
                                "  Ci = x;\n"
                                "}\n";

struct ObserverTest : ::testing::Test {
  Machine machine{{.specialise = false}};
  TableServices services;
  ShadingContext context{machine, services};
  Grid grid = square(5, 4);

  std::unique_ptr<Instance> at_level_0(const std::string& source) {
    auto shader = machine.load(compile(source, 0));
    auto instance = machine.instantiate(*shader, {});
    return std::move(*instance);
  }
};

TEST_F(ObserverTest, SeesCallsTheirPlacesPointsAndVariables) {
  auto surface = at_level_0(kSource);
  Watcher watcher("sqrt");
  context.observe(&watcher);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(watcher.points, 12u); // three columns of five
  EXPECT_THAT(watcher.lines, ElementsAre(4u));
  EXPECT_THAT(watcher.variables, ElementsAre("v"));
  EXPECT_THAT(watcher.shaders, ElementsAre("s"));
}

TEST_F(ObserverTest, ChangesNothing) {
  auto surface = at_level_0(kSource);
  context.shade({.surface = surface.get()}, grid);
  const std::vector<float> expected = red(grid);
  Watcher watcher("sqrt");
  context.observe(&watcher);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(red(grid), expected);
}

TEST_F(ObserverTest, MayLeaveOutCalls) {
  auto surface = at_level_0(kSource);
  Watcher watcher("printonce"); // a printf of uniform values
  watcher.leave_out = true;
  context.observe(&watcher);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(services.printed, "");
  EXPECT_EQ(watcher.points, 0u);
  context.observe(nullptr);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(services.printed, "3");
}

TEST_F(ObserverTest, ProfilerCountsPointsByLine) {
  auto surface =
      at_level_0("surface s() {\n  float x = 0;\n  if (u > 0.4)\n    x = sqrt(v);\n  Ci = x;\n}\n");
  Profiler profiler;
  context.observe(&profiler);
  context.shade({.surface = surface.get()}, grid);
  Profiler sum;
  sum.merge(profiler);
  sum.merge(profiler);
  surface.reset(); // lines outlive the shader
  std::map<uint32_t, ProfileLine> lines;
  for (const ProfileLine& line : profiler.lines())
    lines[line.line] = line;
  EXPECT_EQ(lines[3].points, 20u);
  EXPECT_EQ(lines[4].points, 12u);
  EXPECT_GT(lines[4].seconds, 0);
  EXPECT_EQ(lines[4].file, "test.sl");
  uint64_t doubled = 0;
  for (const ProfileLine& line : sum.lines())
    if (line.line == 4) doubled = line.points;
  EXPECT_EQ(doubled, 24u);
}

TEST_F(ObserverTest, LightsRunInside) {
  auto surface = at_level_0("surface s() { illuminance(P) Ci += Cl; }");
  auto light = at_level_0("light l() {\n solar(vector (0, 0, 1), 0)\n Cl = 2; }");
  services.light_list = {light.get()};
  Profiler profiler;
  Watcher watcher("sqrt");
  context.observe(&watcher);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(watcher.shaders, ElementsAre("s", "l"));
  context.observe(&profiler);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_FALSE(profiler.lines().empty());
}

} // namespace
} // namespace slvm
