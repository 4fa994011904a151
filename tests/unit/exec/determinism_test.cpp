// Results do not depend on strip width, on the optimiser's level, on specialisation or on the number of
// threads.
#include "tests/unit/exec/shading.h"

#include "slvm/kernels/table.h"

#include <cmath>
#include <thread>

namespace slvm {
namespace {

using namespace test;

// Divergent loops, noise, derivatives inside branches, arrays under masks, functions with early returns,
// random.
constexpr const char* kEverything = R"(
float twist(float x; output float y) {
  if (x > 0.6) { y = 1; return x * 2; }
  y = x * x;
  return y + 1;
}
surface everything(float k = 3; string name = "a") {
  float table[5] = {1, 2, 3};
  float sum = 0, i, y = 0;
  for (i = 0; i < 8 * u + k; i += 1) {
    if (mod(i, 3) == 1) continue;
    sum += noise(P * i) * (1 + Du(sum));
    table[mod(i, 5)] += sum;
    if (sum > 4) break;
  }
  float f = twist(v, y);
  point q = P;
  if (name == "a") q += random() * vector N;
  color c = 0;
  illuminance (q, N, PI / 2) { c += Cl * pow(max(0, normalize(L) . normalize(N)), 3); }
  Ci = color(sum + table[floor(v * 4.9)], f + Dv(y), comp(c, 0));
  Oi = spline(u, c, Ci, color(0, 1, 0), c, 1);
}
)";

std::vector<float> run(const Machine& machine, int level, int nu, int nv) {
  auto shader = machine.load(compile(kEverything, level));
  EXPECT_TRUE(shader) << (shader ? "" : shader.error());
  auto surface = machine.instantiate(*shader, {});
  auto light =
      instantiate(machine, "light l() { illuminate(point (0.5, 0.5, -2)) { Cl = noise(Ps) / (L . L); } }");
  TableServices services;
  services.light_list = {light.get()};
  Grid grid = square(nu, nv);
  grid.id = 5;
  ShadingContext context(machine, services);
  context.shade({.surface = surface->get()}, grid);
  std::vector<float> out;
  for (Global g : {Global::kCi, Global::kOi})
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < grid.points(); ++i)
        out.push_back(grid.variable(g).get(c, i));
  return out;
}

TEST(Determinism, StripWidthDoesNotMatter) {
  for (auto [nu, nv] : {std::pair(1, 1), {16, 1}, {17, 1}, {17, 13}, {40, 30}}) {
    std::vector<float> expected = run(Machine({.strip_points = 128}), 2, nu, nv);
    for (uint32_t strip : {16u, 48u, 80u, 256u, 4096u})
      EXPECT_EQ(run(Machine({.strip_points = strip}), 2, nu, nv), expected)
          << strip << " points a strip, " << nu << "x" << nv;
  }
}

TEST(Determinism, OptimiserAndSpecialisationDoNotMatter) {
  std::vector<float> expected = run(Machine({.specialise = false}), 0, 17, 13);
  for (bool specialise : {false, true})
    for (int level : {0, 1, 2})
      EXPECT_EQ(run(Machine({.specialise = specialise}), level, 17, 13), expected)
          << "-O" << level << " specialise " << specialise;
}

TEST(Determinism, RegistersAreNotReadBeforeTheyAreSet) {
  EXPECT_EQ(run(Machine({.poison_registers = true}), 2, 17, 13), run(Machine(), 2, 17, 13));
}

TEST(Determinism, TargetsAgreeWithinRounding) {
  std::vector<float> expected = run(Machine({.target = "EMU128"}), 2, 9, 9);
  for (const char* target : kernel_targets()) {
    std::vector<float> got = run(Machine({.target = target}), 2, 9, 9);
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i)
      EXPECT_NEAR(got[i], expected[i], 2e-4 * (1 + std::fabs(expected[i]))) << target << " value " << i;
  }
}

TEST(Determinism, ThreadsShareInstances) {
  Machine machine;
  std::vector<float> expected = run(machine, 2, 17, 13);
  auto shader = machine.load(compile(kEverything));
  auto surface = machine.instantiate(*shader, {});
  auto light =
      instantiate(machine, "light l() { illuminate(point (0.5, 0.5, -2)) { Cl = noise(Ps) / (L . L); } }");
  std::vector<std::thread> threads;
  std::vector<std::vector<float>> results(4);
  for (std::vector<float>& out : results)
    threads.emplace_back([&] {
      TableServices services;
      services.light_list = {light.get()};
      ShadingContext context(machine, services);
      for (int round = 0; round < 20; ++round) {
        Grid grid = square(17, 13);
        grid.id = 5;
        context.shade({.surface = surface->get()}, grid);
        out.clear();
        for (Global g : {Global::kCi, Global::kOi})
          for (size_t c = 0; c < 3; ++c)
            for (size_t i = 0; i < grid.points(); ++i)
              out.push_back(grid.variable(g).get(c, i));
      }
    });
  for (std::thread& t : threads)
    t.join();
  for (const std::vector<float>& out : results)
    EXPECT_EQ(out, expected);
}

} // namespace
} // namespace slvm
