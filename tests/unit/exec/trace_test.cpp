// trace(), transmission() and their relatives: what they ask of who traces rays, and what they make of the
// answers.
#include "tests/unit/exec/ray_scene.h"

#include <cmath>
#include <numbers>

namespace slvm {
namespace {

using namespace test;

class Trace : public testing::Test {
protected:
  std::vector<float> run(const std::string& statements, int nu = 2, int nv = 1) {
    surface_ = instantiate(machine_, "surface s(output varying float result = 0;) {\n" + statements + "\n}");
    if (!surface_) return {};
    Grid grid = square(nu, nv);
    grid.id = 11;
    ShadingContext context(machine_, services_);
    context.shade({.surface = surface_.get()}, grid);
    std::vector<float> out;
    for (size_t i = 0; i < grid.points(); ++i)
      out.push_back(context.output(*surface_, "result")->get(0, i));
    return out;
  }
  static std::vector<float> all(float x, size_t points = 2) { return std::vector<float>(points, x); }
  std::vector<std::string> messages() const {
    std::vector<std::string> out;
    for (const RuntimeMessage& m : machine_.messages())
      out.push_back(m.text);
    return out;
  }

  Machine machine_;
  RayServicesScene services_;
  RayScene& scene_ = services_.scene;
  std::unique_ptr<Instance> surface_;
};

TEST_F(Trace, DistanceToTheNearest) {
  scene_.surfaces = {plane_at(9), plane_at(4)};
  EXPECT_EQ(run("result = float trace(P, vector (0, 0, 7));"), all(3));
  EXPECT_EQ(scene_.calls.at(0).kind, RayKind::kSpecular);
  EXPECT_FALSE(scene_.calls.at(0).shades);
  EXPECT_EQ(run("result = float trace(P, vector (0, 0, 1 - 2 * u));"), (std::vector<float>{3, 1e30f}));
  EXPECT_EQ(run("result = float trace(P, vector (0, 0, 1), \"maxdist\", 2);"), all(1e30f));
  EXPECT_EQ(run("result = float trace(P, vector (0, 0, 1), \"bias\", 5);"), all(8));
}

TEST_F(Trace, ColourOfTheNearest) {
  scene_.surfaces = {plane_at(4, {0.5f, 0.25f, 1})};
  EXPECT_EQ(run("color c = trace(P, vector (0, 0, 1 - 2 * u)); result = comp(c, 0) + 10 * comp(c, 1) + 100 * "
                "comp(c, 2);"),
            (std::vector<float>{103, 0}));
  EXPECT_EQ(scene_.calls.at(0).outputs, std::vector<std::string>{"shaded:Ci"});
  EXPECT_TRUE(scene_.rays.at(0).has_differentials);
}

TEST_F(Trace, SamplesAreAveraged) {
  scene_.surfaces = {plane_at(4, {0.5f, 0, 0})};
  scene_.too_deep = {1};
  EXPECT_EQ(run("result = comp(trace(P, vector (0, 0, 1), \"samples\", 4, \"samplecone\", 0.1), 0);"),
            all(0.375f));
  EXPECT_EQ(scene_.rays.size(), 8u);
  for (const AskedRay& ray : scene_.rays)
    EXPECT_GE(ray.direction[2], std::cos(0.1) - 1e-6);
  // Distances: the mean of the rays that hit.
  EXPECT_EQ(run("result = float trace(P, vector (0, 0, 1), \"samples\", 4);"), all(3));
}

TEST_F(Trace, OnlyActivePointsShoot) {
  scene_.surfaces = {plane_at(4, {0.5f, 0, 0})};
  EXPECT_EQ(run("if (u > 0.5) result = comp(trace(P, vector (0, 0, 1)), 0); else result = 7;", 4, 1),
            (std::vector<float>{7, 7, 0.5f, 0.5f}));
  EXPECT_EQ(scene_.rays.size(), 2u);
}

TEST_F(Trace, RaysThatAreKnownToMeetNothingAreNotMade) {
  const char* statements[] = {
      "result = comp(trace(P, N), 0);",
      "result = float trace(P, N);",
      "if (u > 0.5) result = float trace(P, N); else result = 3;",
      "result = comp(visibility(P, P + N), 0);",
      "point p = 0; normal n = 7; float d = rayhittest(P, N, p, n);"
      "result = d * 1e-30 + distance(p, P) + xcomp(n);",
      "result = comp(transmission(P, P + N, \"samples\", 4, \"samplecone\", 0.1), 1);",
      "result = comp(color environment(\"raytrace\", N), 2);",
      "result = float environment(\"raytrace\"[3], N, \"fill\", 0.25);",
  };
  for (const char* s : statements) {
    scene_.known_empty = false;
    const std::vector<float> missed = run(s);
    EXPECT_FALSE(scene_.rays.empty()) << s;
    scene_.forget();
    scene_.known_empty = true;
    EXPECT_EQ(run(s), missed) << s;
    EXPECT_TRUE(scene_.rays.empty()) << s;
  }
  EXPECT_TRUE(messages().empty());
}

TEST_F(Trace, TokensArrive) {
  run("result = comp(trace(P, vector (0, 0, 1), \"label\", \"mirror\", \"subset\", \"near\", \"hitmode\", "
      "\"shader\", "
      "\"importance\", color (0.5, 0.25, 0)), 0);");
  const AskedCall& call = scene_.calls.at(0);
  EXPECT_EQ(call.label, "mirror");
  EXPECT_EQ(call.subset, "near");
  EXPECT_EQ(call.mode, HitMode::kShader);
  EXPECT_EQ(scene_.rays.at(0).weight, (Vec{0.5, 0.25, 0}));
}

TEST_F(Trace, SeedsMakeOtherRays) {
  auto rays = [&](const std::string& seed) {
    scene_.forget();
    run("result = float trace(P, vector (0, 0, 1), \"samples\", 4, \"samplecone\", 0.5" + seed + ");");
    std::vector<Vec> out;
    for (const AskedRay& ray : scene_.rays)
      out.push_back(ray.direction);
    return out;
  };
  const auto plain = rays("");
  ASSERT_EQ(plain.size(), 8u);
  EXPECT_EQ(rays(", \"seed\", 0"), plain);
  EXPECT_NE(rays(", \"seed\", 1"), plain);
  EXPECT_EQ(rays(", \"seed\", 1"), rays(", \"seed\", 1"));
  EXPECT_NE(rays(", \"seed\", 1"), rays(", \"seed\", 2"));
}

TEST_F(Trace, WithoutATracer) {
  services_.traces = false;
  EXPECT_EQ(run("result = comp(trace(P, vector (0, 0, 1)), 0) + float trace(P, vector (0, 0, 1)) / 1e30;\n"
                "result += comp(transmission(P, P + vector (0, 0, 1)), 0) + occlusion(P, N, 4);"),
            all(2));
  EXPECT_EQ(messages(), (std::vector<std::string>(2, "nobody traces rays here: they hit nothing")))
      << "one a line";
}

TEST_F(Trace, TransmissionIsTheProductOfWhatIsLetThrough) {
  TestSurface red = plane_at(3), grey = plane_at(5), far = plane_at(20);
  red.opacity = {0, 0.5f, 1};
  grey.opacity = {0.5f, 0.5f, 0.5f};
  scene_.surfaces = {red, grey, far};
  EXPECT_EQ(run("color t = transmission(P, P + vector (0, 0, 8)); result = comp(t, 0) + 10 * comp(t, 1) + "
                "100 * comp(t, 2);"),
            all(0.5f + 2.5f));
  EXPECT_EQ(scene_.calls.at(0).kind, RayKind::kTransmission);
  EXPECT_NEAR(scene_.rays.at(0).max_distance, 8, 1e-6);
  EXPECT_EQ(run("result = float transmission(P, P + vector (0, 0, 8));"), all((0.5f + 0.25f) / 3));
  EXPECT_EQ(run("result = float transmission(P, P);"), all(1));
}

TEST_F(Trace, TransmissionInACone) {
  scene_.surfaces = {plane_at(3)};
  EXPECT_EQ(run("result = float transmission(P, P + vector (0, 0, 8), \"samples\", 16, \"samplecone\", 0.2, "
                "\"bias\", -1);"),
            all(0));
  EXPECT_EQ(scene_.rays.size(), 32u);
  for (const AskedRay& ray : scene_.rays) {
    EXPECT_GE(ray.direction[2], std::cos(0.2) - 1e-6);
    EXPECT_NEAR(ray.max_distance, 8, 1e-6);
    EXPECT_EQ(ray.bias, -1);
  }
  scene_.forget();
  run("result = float transmission(P, P + vector (0, 0, 8), 0.2, 16);"); // the same by position
  EXPECT_EQ(scene_.rays.size(), 32u);
  EXPECT_LT(scene_.rays.at(0).direction[2], 1);
}

TEST_F(Trace, TransmissionStopsWhereRaysAgree) {
  scene_.surfaces = {plane_at(3)};
  run("result = float transmission(P, P + vector (0, 0, 8), \"samples\", 64, \"minsamples\", 8, "
      "\"samplecone\", 0.2);");
  EXPECT_EQ(scene_.rays.size(), 16u);
  scene_.forget();
  scene_.surfaces = {sphere_at({0, 0, 5}, 1)}; // the first point sees its edge, the other one nothing
  const auto half =
      run("result = float transmission(P, point (9 * u, 0, 9), \"samples\", 64, \"minsamples\", 8, "
          "\"samplecone\", 0.5, \"samplebase\", 0);");
  EXPECT_EQ(scene_.rays.size(), 64u + 8);
  EXPECT_GT(half[0], 0);
  EXPECT_LT(half[0], 1);
  EXPECT_EQ(half[1], 1);
}

TEST_F(Trace, VisibilityIsAllOrNothing) {
  TestSurface glass = plane_at(3);
  glass.opacity = {0, 0, 0};
  scene_.surfaces = {glass};
  EXPECT_EQ(run("result = float visibility(P, P + vector (0, 0, 4)) + 10 * float visibility(P, P + vector "
                "(0, 0, 1));"),
            all(10));
  EXPECT_EQ(scene_.calls.at(0).kind, RayKind::kTransmission);
  EXPECT_FALSE(scene_.calls.at(0).shades);
}

TEST_F(Trace, RayHitTest) {
  scene_.surfaces = {plane_at(4)};
  EXPECT_EQ(run("point h = 0; vector n = 0; float d = rayhittest(P, vector (0, 0, 1 - 2 * u), h, n);"
                "result = d < 1e30 ? d + 10 * zcomp(h) + 100 * zcomp(n) : -zcomp(h);"),
            (std::vector<float>{143, -1}));
  EXPECT_EQ(scene_.calls.at(0).outputs, std::vector<std::string>{"primitive:N"});
}

TEST_F(Trace, FullTrace) {
  scene_.surfaces = {plane_at(4, {0.5f, 0, 0})};
  EXPECT_EQ(
      run("color c = 0; float d = 0; point h = 0, m = 0; vector n = 0, r = 0;"
          "float x = fulltrace(P, vector (0, 0, 2 - 4 * u), c, d, h, n, m, r);"
          "if (x == d) result = comp(c, 0) + (d < 1e30 ? d * 10 : 0) + 100 * zcomp(n) + 1000 * zcomp(r) + "
          "10000 * zcomp(h);"),
      (std::vector<float>{0.5f + 30 + 100 + 40000, 10000 - 1000}));
}

TEST_F(Trace, EnvironmentOfRays) {
  scene_.surfaces = {plane_at(4, {0.5f, 0.25f, 1})};
  EXPECT_EQ(run("color c = environment(\"raytrace\", vector (0, 0, 1 - 2 * u)); result = comp(c, 0) + 10 * "
                "comp(c, 1);"),
            (std::vector<float>{3, 0}));
  EXPECT_EQ(scene_.calls.at(0).kind, RayKind::kSpecular);
  EXPECT_EQ(
      run("result = float environment(\"raytrace\"[1], vector (0, 0, 1), \"label\", \"l\", \"maxdist\", 5);"),
      all(0.25f));
  EXPECT_EQ(scene_.calls.back().label, "l");
  EXPECT_EQ(scene_.rays.back().max_distance, 5);
  scene_.forget();
  run("result = comp(environment(\"raytrace\", vector (0, 0, 1), \"samples\", 16, \"blur\", 0.1), 0);");
  EXPECT_EQ(scene_.rays.size(), 32u);
  double least = 1;
  for (const AskedRay& ray : scene_.rays)
    least = std::min(least, ray.direction[2]);
  EXPECT_GE(least, std::cos(0.1 * std::numbers::pi) - 1e-6);
  EXPECT_LT(least, std::cos(0.08 * std::numbers::pi));
  scene_.forget();
  run("result = comp(environment(\"raytrace\", vector (0.1, 0, 1), vector (-0.1, 0, 1), vector (0, 0.1, 1), "
      "vector (0, -0.1, 1), "
      "\"samples\", 16), 0);");
  for (const AskedRay& ray : scene_.rays)
    EXPECT_GE(ray.direction[2], std::cos(std::atan(0.1)) - 1e-5);
}

TEST_F(Trace, ShadowOfRaysInALight) {
  TestSurface glass = plane_at(0);
  glass.opacity = {0.25f, 0.5f, 1};
  scene_.surfaces = {glass};
  auto light =
      instantiate(machine_, "light l() { illuminate (point (0.5, 0, -3)) Cl = shadow(\"raytrace\", Ps); }");
  auto sun =
      instantiate(machine_, "light s() { solar (vector (0, 0, 1), 0) Cl = float shadow(\"raytrace\", Ps); }");
  services_.light_list = {light.get()};
  const std::string loop = "illuminance (P) result = comp(Cl, 0) + 10 * comp(Cl, 1) + 100 * comp(Cl, 2);";
  EXPECT_EQ(run(loop), all(0.25f + 5 + 100));
  EXPECT_NEAR(scene_.rays.at(0).max_distance, std::sqrt(16.25), 1e-5);
  scene_.forget();
  services_.light_list = {sun.get()};
  const auto mean = run(loop);
  EXPECT_FLOAT_EQ(mean[0], 111 * (1 - (0.75f + 0.5f + 0) / 3));
  EXPECT_GT(scene_.rays.at(0).max_distance, 1e5);
  EXPECT_NEAR(scene_.rays.at(0).direction[2], -1, 1e-6);
  // What maps need many samples for needs one ray, if nothing is soft.
  for (auto [blur, rays] : {std::pair("0", 1u), {"0.01", 16u}}) {
    scene_.forget();
    auto old = instantiate(machine_, std::string("light o() { illuminate (point (0.5, 0, -3)) Cl = float "
                                                 "shadow(\"raytrace\", Ps, \"samples\", 16, \"blur\", ") +
                                         blur + "); }");
    services_.light_list = {old.get()};
    run(loop);
    EXPECT_EQ(scene_.rays.size(), 2 * rays) << blur;
  }
}

TEST_F(Trace, ShadowOfRaysInALightLoop) {
  TestSurface wall = plane_at(0);
  scene_.surfaces = {wall};
  auto light = instantiate(machine_, "light l() { illuminate (point (0.5, 0, -3)) Cl = 1; }");
  services_.light_list = {light.get()};
  EXPECT_EQ(run("illuminance (P) result = float shadow(\"raytrace\", P);"), all(1));
  EXPECT_NEAR(scene_.rays.at(0).max_distance, std::sqrt(16.25), 1e-5);
  EXPECT_EQ(run("result = float shadow(\"raytrace\", P);"), all(0));
  EXPECT_EQ(messages(), std::vector<std::string>{"shadow \"raytrace\": there is no light here"});
}

TEST_F(Trace, OcclusionAsksAboutAllPoints) {
  EXPECT_EQ(run("if (u > 0.2) result = occlusion(P, 2 * N, 64);", 3, 2),
            (std::vector<float>{0, 1.25f, 2.25f, 0, 4.25f, 5.25f}));
  const AskedHemisphere& h = scene_.hemispheres.at(0);
  EXPECT_EQ(h.active, (std::vector<uint8_t>{0, 1, 1, 0, 1, 1}));
  EXPECT_EQ(h.call.kind, RayKind::kDiffuse);
  EXPECT_FALSE(h.call.shades);
  EXPECT_EQ(h.samples, 64);
  EXPECT_EQ(h.min_samples, 0);
  EXPECT_TRUE(h.cosine && h.wants_occlusion && !h.wants_radiance && !h.wants_colour);
  EXPECT_EQ(h.cone_angle, -7);
  EXPECT_EQ(h.max_distance, -7);
  EXPECT_EQ(h.bias, -7);
  EXPECT_EQ(h.sample_base, 1);
  EXPECT_EQ(h.max_error, -1);
  EXPECT_EQ(h.along_u, (Vec{0.5, 0, 0}));
  EXPECT_EQ(h.along_v, (Vec{0, 1, 0}));
}

TEST_F(Trace, OcclusionPassesItsArguments) {
  Matrix4 world;
  world(0, 0) = 2;
  world(3, 1) = 7;
  services_.spaces["world"] = world;
  const auto result = run(R"(color c = 0; vector d = 0;
    result = occlusion(P, N, 16, "minsamples", 4, "coneangle", PI / 4, "maxdist", 7, "bias", 0.5, "samplebase", 0.25,
      "distribution", "uniform", "maxerror", 0.125, "maxpixeldist", 9, "falloff", 2, "falloffmode", 1, "environmentmap", "sky",
      "environmentspace", "world", "coordsystem", "shader", "subset", "walls", "label", "dim", "hitsides", "back", "weight",
      color (0.5, 0.5, 0.25), "environmentcolor", c, "environmentdir", d);
    result += 1000 * comp(c, 2) + 100000 * ycomp(d);)");
  EXPECT_EQ(result, (std::vector<float>{0.25f + 2000 + 100000, 1.25f + 12000 + 10100000}));
  const AskedHemisphere& h = scene_.hemispheres.at(0);
  EXPECT_EQ(h.min_samples, 4);
  EXPECT_FLOAT_EQ(static_cast<float>(h.cone_angle), std::numbers::pi_v<float> / 4);
  EXPECT_EQ(h.max_distance, 7);
  EXPECT_EQ(h.bias, 0.5);
  EXPECT_EQ(h.sample_base, 0.25);
  EXPECT_FALSE(h.cosine);
  EXPECT_EQ(h.max_error, 0.125f);
  EXPECT_EQ(h.max_pixel_distance, 9);
  EXPECT_EQ(h.falloff, 2);
  EXPECT_TRUE(h.power);
  EXPECT_EQ(h.map, "sky");
  EXPECT_EQ(h.to_map * world, Matrix4{});
  EXPECT_EQ(h.cache_space, "shader");
  EXPECT_EQ(h.call.subset, "walls");
  EXPECT_EQ(h.call.label, "dim");
  EXPECT_EQ(h.call.sides, HitSides::kBack);
  EXPECT_EQ(h.weight, (Vec{0.5, 0.5, 0.25}));
  EXPECT_TRUE(h.wants_colour && h.wants_direction);
}

TEST_F(Trace, AdaptiveSamplingCanBeTurnedOff) {
  run("result = occlusion(P, N, 16, \"minsamples\", 4, \"adaptive\", 0);");
  EXPECT_EQ(scene_.hemispheres.at(0).min_samples, 0);
  run("result = occlusion(P, N, 16, \"minsamples\", 4, \"adaptive\", 1);");
  EXPECT_EQ(scene_.hemispheres.at(1).min_samples, 4);
  auto shadow_rays = [&](const std::string& adaptive) {
    scene_.forget();
    run("result = float transmission(P, P + vector (0, 0, 1), \"samples\", 16, \"minsamples\", 4, "
        "\"adaptive\", " +
        adaptive + ");");
    return scene_.rays.size();
  };
  EXPECT_EQ(shadow_rays("1"), 2u * 4);
  EXPECT_EQ(shadow_rays("0"), 2u * 16);
}

TEST_F(Trace, IndirectDiffuse) {
  EXPECT_EQ(run("float o = 7; color c = indirectdiffuse(P, N, 8, \"occlusion\", o); result = comp(c, 1) + "
                "100 * o;"),
            (std::vector<float>{1 + 25, 2 + 125}));
  const AskedHemisphere& h = scene_.hemispheres.at(0);
  EXPECT_TRUE(h.call.shades && h.wants_radiance && h.wants_occlusion);
}

TEST_F(Trace, OutputsOfMaskedPointsKeepTheirValue) {
  EXPECT_EQ(run("float o = 7; if (u > 0.5) indirectdiffuse(P, N, 8, \"occlusion\", o); result = o;"),
            (std::vector<float>{7, 1.25f}));
}

TEST_F(Trace, HemisphereMessages) {
  scene_.map_problem = "there is no sky.tex";
  run("vector i = 0; result = occlusion(P, N, 8, \"pointbased\", 1, \"illuminationdir\", i);");
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"occlusion: \"illuminationdir\" is not set",
                                      "occlusion: there are no point clouds here; rays are traced",
                                      "occlusion: there is no sky.tex"}));
}

TEST_F(Trace, MapsLieInTheSpacesThatShadersKnow) {
  run("result = occlusion(P, N, 8, \"environmentmap\", \"sky\", \"environmentspace\", \"nowhere\");\n"
      "result += occlusion(P, N, 8, \"environmentmap\", \"sky\", \"environmentspace\", \"object\");");
  EXPECT_EQ(messages(), std::vector<std::string>{"occlusion: there is no coordinate system \"nowhere\""});
  EXPECT_EQ(scene_.hemispheres.at(0).to_map, Matrix4{});
}

TEST_F(Trace, CallsThatMeanAPointCloudHaveRays) {
  run("result = occlusion(P, N, 0, \"filename\", \"room.ptc\") + occlusion(P, N, 8, \"pointbased\", 1) + "
      "occlusion(P, N, 0);");
  ASSERT_EQ(scene_.hemispheres.size(), 3u);
  EXPECT_EQ(scene_.hemispheres[0].samples, 64);
  EXPECT_EQ(scene_.hemispheres[1].samples, 8);
  EXPECT_EQ(scene_.hemispheres[2].samples, 1);
  EXPECT_EQ(messages(),
            (std::vector<std::string>{"occlusion: there are no point clouds here; rays are traced"}));
}

TEST_F(Trace, NowhereToLookWithoutNormal) {
  EXPECT_EQ(run("result = 3 + occlusion(P, u * N, 8);"), (std::vector<float>{3, 4.25f}));
  EXPECT_EQ(scene_.hemispheres.at(0).active, (std::vector<uint8_t>{0, 1}));
}

/// A sky that is as bright as the cosine to +y, above the horizon.
class CosineSky : public TextureServices {
public:
  std::string texture(const TextureLookup&) override { return "none"; }
  std::string shadow(const TextureLookup&) override { return "none"; }
  bool info(std::string_view, std::string_view, const Matrix4&, Value&) override { return false; }
  std::string environment(const TextureLookup& l) override {
    if (l.map != "sky") return "no such map";
    for (size_t i = 0; i < l.points; ++i)
      for (size_t c = 0; c < l.channels; ++c)
        if (l.active(i)) l.result[c][i] = std::max(0.0f, l.centre[1][i]) * static_cast<float>(c + 1);
    return "";
  }
};

class SkyServices : public RayServicesScene {
public:
  TextureServices* textures() override { return &sky; }
  CosineSky sky;
};

TEST_F(Trace, DiffuseLightOfAMap) {
  SkyServices services;
  auto surface =
      instantiate(machine_, "surface s() { Ci = indirectdiffuse(\"sky\", vector (0, 3 - 6 * u, 0)); "
                            "Oi = indirectdiffuse(\"\", N); }");
  Grid grid = square(2, 1);
  ShadingContext context(machine_, services);
  context.shade({.surface = surface.get()}, grid);
  // 1 / PI times the integral of cos^2 over the half space: 2 / 3.
  EXPECT_NEAR(grid.variable(Global::kCi).get(0, 0), 2.0 / 3, 2e-3);
  EXPECT_NEAR(grid.variable(Global::kCi).get(2, 0), 2, 6e-3);
  EXPECT_NEAR(grid.variable(Global::kCi).get(0, 1), 0, 1e-5);
  EXPECT_EQ(grid.variable(Global::kOi).get(0, 0), 0);
  EXPECT_TRUE(messages().empty());
}

TEST_F(Trace, RayInfoTellsTheWeight) {
  auto surface = instantiate(
      machine_,
      "surface s(output varying float result = 0;) { color w = 0; float f = 0; "
      "result = rayinfo(\"weight\", w) + rayinfo(\"importance\", f) + 10 * comp(w, 1) + 100 * f; }");
  Grid grid = square(2, 1);
  const float red[] = {1, 0.5f}, green[] = {0.25f, 1}, blue[] = {0.25f, 0.0f};
  ShadingContext context(machine_, services_);
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(context.output(*surface, "result")->get(0, 1), 112);
  grid.ray.weight[0] = red, grid.ray.weight[1] = green, grid.ray.weight[2] = blue;
  context.shade({.surface = surface.get()}, grid);
  EXPECT_EQ(context.output(*surface, "result")->get(0, 0), 2 + 2.5f + 50);
  EXPECT_EQ(context.output(*surface, "result")->get(0, 1), 2 + 10 + 50);
}

} // namespace
} // namespace slvm
