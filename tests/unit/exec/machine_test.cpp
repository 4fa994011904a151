// The machine's public interface: parameters, outputs, messages, errors, derivatives under divergence.
#include "tests/unit/exec/shading.h"

#include <cmath>
#include <gmock/gmock.h>

namespace slvm {
namespace {

using namespace test;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::Not;

struct MachineTest : ::testing::Test {
  Machine machine;
  TableServices services;

  std::vector<float> shade(const std::string& source, int n = 5, std::vector<ParamValue> params = {}) {
    auto surface = instantiate(machine, source, std::move(params));
    Grid grid = square(n, n);
    ShadingContext context(machine, services);
    if (surface) context.shade({.surface = surface.get()}, grid);
    return red(grid);
  }
};

TEST_F(MachineTest, ParametersReplaceDefaults) {
  EXPECT_THAT(shade("surface s(float k = 2) { Ci = k; }"), Each(2.0f));
  EXPECT_THAT(shade("surface s(float k = 2) { Ci = k; }", 5, {number("k", 7)}), Each(7.0f));
}

TEST_F(MachineTest, DefaultsMayUseOtherParameters) {
  EXPECT_THAT(shade("surface s(float k = 2; float l = 3 * k) { Ci = l; }"), Each(6.0f));
  EXPECT_THAT(shade("surface s(float k = 2; float l = 3 * k) { Ci = l; }", 5, {number("k", 5)}), Each(15.0f));
}

TEST_F(MachineTest, WrongParametersAreNamed) {
  auto shader = machine.load(compile("surface s(float roughness = 2; color c = 1) { Ci = roughness * c; }"));
  ASSERT_TRUE(shader);
  std::vector<ParamValue> wrong{number("roughnes", 1)};
  auto unknown = machine.instantiate(*shader, wrong);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error(), "surface \"s\" has no parameter 'roughnes'; did you mean 'roughness'?");
  wrong = {number("c", 1)};
  auto type = machine.instantiate(*shader, wrong);
  ASSERT_FALSE(type);
  EXPECT_EQ(type.error(), "parameter 'c' is a color, not a float");
}

TEST_F(MachineTest, WhatTheBuildCannotServeIsNamedAtBinding) {
  auto shader = machine.load(
      compile("surface s(string map = \"\") { if (map != \"\") Ci = occlusion(map, P, N, 1); }"));
  ASSERT_TRUE(shader);
  std::vector<ParamValue> map{{"map", {Type::kString, 0, {}, {"brick.tx"}}}};
  auto traced = machine.instantiate(*shader, map);
  ASSERT_FALSE(traced);
  EXPECT_EQ(traced.error(), "surface \"s\" calls 'occlusion', which this build cannot serve");
  EXPECT_TRUE(machine.instantiate(*shader, {})); // the default needs no photons
}

TEST_F(MachineTest, WhatTheBuildCannotServeGivesZeroWhereThatIsWanted) {
  Machine lenient({.zero_for_unserved = true});
  auto surface =
      instantiate(lenient, "surface s(string file = \"x\") { color got = 5; float found = 1;"
                           "found = texture3d(file, P, N, \"c\", got); bake(file, s, t, P);"
                           "Ci = 0.25 + occlusion(file, P, N, 4); Oi = color(found, comp(got, 0), 0); }");
  Grid grid = square(3, 1);
  ShadingContext context(lenient, services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid), Each(0.25f));
  EXPECT_EQ(grid.variable(Global::kOi).get(0, 1), 0.0f);
  EXPECT_EQ(grid.variable(Global::kOi).get(1, 1), 5.0f); // what it would bring stays as it was
  std::vector<RuntimeMessage> messages = lenient.messages();
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[1].text, "occlusion: this version cannot carry it out; its results are 0");
  EXPECT_EQ(messages[1].severity, MessageSeverity::kWarning);
  EXPECT_EQ(messages[1].points, 3u);
}

// Of a surface only some outputs: what they do not need does not run.
TEST_F(MachineTest, NarrowedSurfacesComputeWhatIsWanted) {
  const std::string lit =
      "surface s(float k = 2; output varying float seen = 1) { seen = xcomp(P); printf(\"x\");"
      "Oi = k * Os; Ci = Oi * diffuse(N) + trace(P, N); }";
  auto all = instantiate(machine, lit, {number("k", 0.25f)});
  const std::vector<std::string> opacity{"Oi"};
  auto narrow = machine.narrowed(*all, opacity);
  ASSERT_TRUE(narrow);
  EXPECT_THAT(narrow->program().imports, Not(::testing::IsEmpty())); // printf stays
  for (ShadeopId id : narrow->program().imports)
    EXPECT_NE(shadeop(id).name, "trace");
  Grid grid = square(2, 2);
  ShadingContext context(machine, services);
  context.shade({.surface = narrow.get()}, grid);
  EXPECT_EQ(grid.variable(Global::kOi).get(1, 3), 0.25f); // of the value the parameter was given
  EXPECT_EQ(grid.variable(Global::kCi).get(1, 3), 0.0f);  // as it started
  EXPECT_THAT(services.printed, HasSubstr("x"));
  const Planes* seen = context.output(*narrow, "seen");
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->get(0, 2), 1.0f); // its default

  const std::vector<std::string> both{"Oi", "seen"};
  auto with_seen = machine.narrowed(*all, both);
  ASSERT_TRUE(with_seen);
  context.shade({.surface = with_seen.get()}, grid);
  seen = context.output(*with_seen, "seen");
  EXPECT_EQ(seen->get(0, 3), 1.0f);
  EXPECT_EQ(seen->get(0, 2), 0.0f);
}

TEST_F(MachineTest, SurfacesThatOthersMayLookAtAreNotNarrowed) {
  const std::vector<std::string> opacity{"Oi"}, colour{"Ci"};
  auto lights =
      instantiate(machine, "surface s(output varying float x = 1) { x = u; Oi = diffuse(N); Ci = x; }");
  EXPECT_FALSE(machine.narrowed(*lights, opacity)); // a light may ask for x, by surface("x", ...)
  auto plain = instantiate(machine, "surface s() { Ci = u; }");
  EXPECT_FALSE(machine.narrowed(*plain, colour)); // there is nothing else
}

TEST_F(MachineTest, PointParametersAreInShaderSpace) {
  InstanceOptions moved;
  moved.shader_to_current.m[12] = 10; // x + 10
  auto by_default =
      instantiate(machine, "surface s(point p = point \"shader\" (1, 2, 3)) { Ci = xcomp(p); }", {}, moved);
  std::vector<ParamValue> given{{"p", {Type::kPoint, 0, {5, 0, 0}, {}}}};
  auto by_value = instantiate(machine, "surface s(point p = point \"shader\" (1, 2, 3)) { Ci = xcomp(p); }",
                              given, moved);
  Grid grid = square(2, 2);
  ShadingContext context(machine, services);
  context.shade({.surface = by_default.get()}, grid);
  EXPECT_THAT(red(grid), Each(11.0f));
  context.shade({.surface = by_value.get()}, grid);
  EXPECT_THAT(red(grid), Each(15.0f));
}

TEST_F(MachineTest, PrimitiveVariablesOverrideParameters) {
  auto surface = instantiate(machine, "surface s(varying float k = 2) { Ci = k; }", {}, {.may_vary = {"k"}});
  Grid grid = square(2, 2);
  float* k = grid.add_varying_primvar("k", Type::kFloat);
  for (int i = 0; i < 4; ++i)
    k[i] = static_cast<float>(i);
  ShadingContext context(machine, services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid), ElementsAre(0, 1, 2, 3));
}

TEST_F(MachineTest, OutputParametersCanBeRead) {
  auto surface = instantiate(machine, "surface s(output varying float twice = 0) { twice = 2 * u; }");
  Grid grid = square(3, 1);
  ShadingContext context(machine, services);
  context.shade({.surface = surface.get()}, grid);
  const Planes* twice = context.output(*surface, "twice");
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->get(0, 0), 0);
  EXPECT_EQ(twice->get(0, 2), 2);
  EXPECT_EQ(context.output(*surface, "thrice"), nullptr);
}

TEST_F(MachineTest, CiBeginsBlackAndOiAsSurfaceOpacity) {
  Grid grid = square(2, 2);
  grid.set_uniform(Global::kOs, std::vector<float>{0.25f, 0.5f, 1});
  auto surface = instantiate(machine, "surface s() { Ci += color(0, 0, .125); }");
  ShadingContext context(machine, services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid), Each(0.0f));
  EXPECT_THAT(red(grid, 2), Each(0.125f));
  EXPECT_EQ(grid.variable(Global::kOi).get(0, 3), 0.25f);
  EXPECT_EQ(grid.variable(Global::kOi).get(1, 3), 0.5f);
}

TEST_F(MachineTest, RuntimeErrorsAreReportedOnceWithACount) {
  std::vector<float> ci = shade("surface s() {\n float a[3] = {1, 2, 3};\n Ci = a[floor(u * 4)];\n}");
  EXPECT_THAT(std::vector<float>(ci.begin(), ci.begin() + 5), ElementsAre(1, 2, 3, 0, 0));
  std::vector<RuntimeMessage> messages = machine.messages();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].text, "array subscript 3 is outside 0..2");
  EXPECT_EQ(messages[0].file, "test.sl");
  EXPECT_EQ(messages[0].line, 3u);
  EXPECT_EQ(messages[0].shader, "surface \"s\"");
  EXPECT_EQ(messages[0].points, 10u);
}

TEST_F(MachineTest, ValuesAreNotSentToLightsThatCannotRunWithThem) {
  auto light = instantiate(machine, "light l(float w = 1; float traced = 0;) { illuminate (point (0, 0, 0)) {"
                                    " Cl = w; if (traced == 1) Cl *= occlusion(\"x\", Ps, Ns, 1); } }");
  services.light_list = {light.get()};
  auto surface = instantiate(machine, "surface s() { illuminance (P, \"send:light:w\", 5) Ci = Cl; }");
  Grid grid = square(3, 1);
  ShadingContext context(machine, services);
  for (int i = 0; i < 2; ++i)
    context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid), Each(1.0f));
  ASSERT_EQ(machine.messages().size(), 1u);
  EXPECT_EQ(machine.messages()[0].text,
            "no values can be sent to it: light \"l\" calls 'occlusion', which this build cannot serve");
  EXPECT_EQ(machine.messages()[0].times, 1u);
}

TEST_F(MachineTest, LoopsWithoutEndAreLeft) {
  Machine patient({.most_rounds = 1000});
  auto surface = instantiate(patient, "surface s(output varying float n = 0;) {\n float i = 0;\n"
                                      " while (i < 1) {\n  i *= 0.5; n += 1;\n }\n Ci = 3;\n}");
  Grid grid = square(5, 1);
  ShadingContext context(patient, services);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_THAT(red(grid), Each(3.0f));
  ASSERT_EQ(patient.messages().size(), 1u);
  EXPECT_EQ(patient.messages()[0].text, "a loop has not ended after 1000 rounds, and is left");
  EXPECT_EQ(patient.messages()[0].line, 3u);
  EXPECT_EQ(patient.messages()[0].points, 5u);
}

TEST_F(MachineTest, MessagesNameTheLineOfTheirCallWhateverWaitsBeforeIt) {
  shade("surface s(output varying float x = 0;) {\n if (u > 0.4)\n x = sqrt(v);\n error(\"here\");\n}");
  ASSERT_EQ(machine.messages().size(), 1u);
  EXPECT_EQ(machine.messages()[0].line, 4u);
}

TEST_F(MachineTest, MessagesReachTheApplicationAsTheyOccurAndAreFolded) {
  std::vector<RuntimeMessage> log;
  Machine logged({.on_message = [&](const RuntimeMessage& m) { log.push_back(m); }});
  auto surface =
      instantiate(logged, "surface s() {\n warning(\"old\");\n if (u > 0.6) error(\"u is %g\", u);\n}");
  Grid grid = square(5, 1);
  ShadingContext context(logged, services);
  for (int i = 0; i < 3; ++i)
    context.shade({.surface = surface.get()}, grid);
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].text, "old");
  EXPECT_EQ(log[0].severity, MessageSeverity::kWarning);
  EXPECT_EQ(log[1].text, "u is 0.75");
  EXPECT_EQ(log[1].line, 3u);
  EXPECT_EQ(log[1].points, 2u);
  std::vector<RuntimeMessage> folded = logged.messages();
  ASSERT_EQ(folded.size(), 2u);
  EXPECT_EQ(folded[1].times, 3u);
  EXPECT_EQ(folded[1].points, 6u);
}

TEST_F(MachineTest, UnknownSpacesAreReported) {
  shade("surface s() { Ci = xcomp(transform(\"nowhere\", P)); }");
  ASSERT_EQ(machine.messages().size(), 1u);
  EXPECT_EQ(machine.messages()[0].text, "unknown coordinate system \"nowhere\"");
}

TEST_F(MachineTest, AttributesOfTheWrongTypeAreReported) {
  services.attributes["user:a"] = {Type::kColor, 0, {1, 2, 3}, {}};
  EXPECT_THAT(
      shade("surface s() { uniform float x = 9; float f = attribute(\"user:a\", x); Ci = x + 100 * f; }"),
      Each(9.0f));
  ASSERT_EQ(machine.messages().size(), 1u);
  EXPECT_EQ(machine.messages()[0].text, "attribute \"user:a\" is a color, not a float");
}

TEST_F(MachineTest, PrintfRunsOncePerActivePoint) {
  shade("surface s() { printf(\"once\\n\"); if (u > 0.6) printf(\"%f %d %s|\", u, 7.9, \"x\"); }", 3);
  EXPECT_EQ(services.printed, "once\n1.000000 7 x|1.000000 7 x|1.000000 7 x|");
}

TEST_F(MachineTest, DerivativesUnderDivergence) {
  // Operands without side effects are computed in all lanes: the difference at the branch's edge stays
  // centred.
  std::vector<float> ci = shade("surface s() { float x = u * u; Ci = -1; if (u > 0.4) { Ci = Du(x); } }", 5);
  EXPECT_THAT(std::vector<float>(ci.begin(), ci.begin() + 5),
              ElementsAre(-1, -1, FloatNear(1, 1e-5f), FloatNear(1.5f, 1e-5f), FloatNear(1.75f, 1e-5f)));
  // A variable that only some lanes assigned is differenced among those.
  ci = shade("surface s() { float x = 0; Ci = -1; if (u > 0.4) { float i; for (i = 0; i < u * 4; i += 1) { x "
             "= u * u; } Ci = Du(x); } }",
             5);
  EXPECT_THAT(std::vector<float>(ci.begin(), ci.begin() + 5),
              ElementsAre(-1, -1, FloatNear(1.25f, 1e-5f), FloatNear(1.5f, 1e-5f), FloatNear(1.75f, 1e-5f)));
}

TEST_F(MachineTest, SinglePointGridsHaveNoDerivatives) {
  EXPECT_THAT(shade("surface s() { Ci = Du(P . P) + Dv(u) + area(P); }", 1), ElementsAre(0));
}

TEST_F(MachineTest, PiecesOfAGridHaveDerivativesOfTheirOwn) {
  // Three pieces, 2 by 3 points each; without respect for their seams, rows 2 and 3 and others would mix.
  auto surface = instantiate(machine, "surface s() { Ci = color(Dv(s), Du(s), area(P)); }");
  Grid whole(2, 9);
  whole.lattice = Lattice::kPieces;
  whole.piece_rows = 3;
  auto fill = [](Grid& grid, size_t at, size_t piece) {
    float *p = grid.varying(Global::kP), *s = grid.varying(Global::ks);
    size_t pitch = grid.pitch();
    for (size_t j = 0; j < 3; ++j)
      for (size_t i = 0; i < 2; ++i, ++at) {
        auto x = static_cast<float>(i), y = static_cast<float>(j), k = static_cast<float>(piece + 1);
        p[at] = k * x + 100 * k;
        p[pitch + at] = y * y - 7 * k;
        p[2 * pitch + at] = 1;
        s[at] = k * (x + 1) * y * y + 50 * k;
      }
  };
  for (size_t piece = 0; piece < 3; ++piece)
    fill(whole, 6 * piece, piece);
  ShadingContext context(machine, services);
  context.shade({.surface = surface.get()}, whole);
  for (size_t piece = 0; piece < 3; ++piece) {
    Grid alone(2, 3);
    fill(alone, 0, piece);
    context.shade({.surface = surface.get()}, alone);
    for (size_t component = 0; component < 3; ++component) {
      std::vector<float> expected = red(alone, component), got = red(whole, component);
      for (size_t i = 0; i < 6; ++i)
        EXPECT_FLOAT_EQ(got[6 * piece + i], expected[i]) << piece << ' ' << component << ' ' << i;
    }
  }
}

TEST_F(MachineTest, DisplacementThenSurfaceThenAtmosphere) {
  auto d = instantiate(machine, "displacement d(output varying float h = 0) { h = 0.5; P += h * N; }");
  auto s =
      instantiate(machine, "surface s() { float h = -1; displacement(\"h\", h); Ci = zcomp(P) + 10 * h; }");
  auto a = instantiate(machine, "volume a() { Ci *= 2; }");
  Grid grid = square(2, 2);
  ShadingContext context(machine, services);
  context.shade({.displacement = d.get(), .surface = s.get(), .atmosphere = a.get()}, grid);
  EXPECT_THAT(red(grid), Each(11.0f)); // 2 * (0.5 + 5)
}

TEST_F(MachineTest, RandomDiffersByPointCallAndGridAndRepeats) {
  const char* source = "surface s() { Ci = color(random(), random(), 0); }";
  auto surface = instantiate(machine, source);
  auto values = [&](uint64_t id, size_t component) {
    Grid grid = square(4, 4);
    grid.id = id;
    ShadingContext context(machine, services);
    context.shade({.surface = surface.get()}, grid);
    return red(grid, component);
  };
  EXPECT_EQ(values(1, 0), values(1, 0));
  EXPECT_NE(values(1, 0), values(2, 0));
  EXPECT_NE(values(1, 0), values(1, 1));
  std::vector<float> v = values(1, 0);
  EXPECT_NE(v[0], v[1]);
  for (float x : v)
    EXPECT_TRUE(x >= 0 && x < 1);
}

TEST_F(MachineTest, UniformRandomIsOneDrawAGrid) {
  std::vector<float> v = shade("surface s() { uniform float x = random(); Ci = x; }");
  EXPECT_THAT(v, Each(v[0]));
}

} // namespace
} // namespace slvm
