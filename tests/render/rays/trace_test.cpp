// Rays and what they hit: distances, who sees what, how deep rays go, what is told about a hit.
#include "tests/render/rays/ray_scene.h"

#include "render/texture/image_file.h"
#include "tests/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

using slvm::RayKind;
using slvm::Type;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;

const std::string kSeen = "Attribute \"visibility\" \"trace\" 1 \"transmission\" \"opaque\" ";

std::string world(const std::string& rib) {
  return "Projection \"perspective\" \"fov\" 45 WorldBegin " + kSeen + rib + " WorldEnd";
}

TEST(Trace, distances_are_those_of_the_surfaces) {
  RayScene s(
      world("Translate 0 0 5 Sphere 1 -1 1 360 Translate 0 0 5 Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0]"));
  EXPECT_EQ(s.messages(), "");
  EXPECT_NEAR(s.distance({}), 4, 2e-3f);
  EXPECT_NEAR(s.distance({{0, 0, 5}, {0, 0, 1}}), 1, 2e-3f) << "from inside";
  EXPECT_NEAR(s.distance({{3, 0, 0}}), 10, 1e-5f);
  EXPECT_NEAR(s.distance({{3, 0, 0}, {0, 3, 4}}), 12.5, 1e-5f);
  EXPECT_EQ(s.distance({{0, 0, 11}}), kInfinity);
  EXPECT_EQ(s.distance({{}, {0, 0, 1}, 3.9f}), kInfinity) << "maxdist";
  EXPECT_NEAR(s.distance({{}, {0, 0, 1}, 4.1f}), 4, 2e-3f);
  EXPECT_NEAR(s.distance({{}, {0, 0, 1}, kInfinity, 4.5f}), 6, 2e-3f) << "bias";
}

TEST(Trace, textures_at_hits_are_looked_up_at_their_s_and_t) {
  anemone::test::TempFolder folder;
  ImageFile file;
  file.path = (folder / "ramp.tif").string();
  file.format = "tiff";
  file.width = 64;
  file.height = 1;
  file.full_width = 64;
  file.full_height = 1;
  file.channels = {"R"};
  for (int x = 0; x < 64; ++x)
    file.pixels.push_back(static_cast<std::byte>(4 * x));
  ASSERT_EQ(write_image_file(file), "");
  // Without coordinates, and with s and t of the shader's own.
  for (const char* lookup : {"texture(name)", "texture(name, s, t)"}) {
    RayScene s(world("Surface \"picture\" \"name\" \"" + file.path +
                     "\" Patch \"bilinear\" \"P\" [-1 -1 5 1 -1 5 -1 1 5 1 1 5]"),
               {{"picture",
                 std::string("surface picture(string name = \"\") { Ci = float ") + lookup + "; Oi = 1; }"}});
    for (float x : {-0.5f, 0.25f, 0.75f}) {
      std::vector<float> Ci = s.value({{x, 0, 0}}, "surface:Ci", Type::kColor);
      ASSERT_EQ(Ci.size(), 3u) << lookup << s.messages();
      EXPECT_NEAR(Ci[0], ((0.5f + 0.5f * x) * 64 - 0.5f) * 4 / 255, 0.005f) << lookup << ' ' << x;
    }
  }
}

TEST(Trace, hits_are_evaluated_where_the_ray_meets_the_surface) {
  // A trapezoid, a triangle, a sphere, a bicubic patch: their parameters are not those of flat faces.
  for (const char* shape :
       {"Polygon \"P\" [-2 -1 0 2 -1 0 .5 1 0 -.5 1 0]", "Polygon \"P\" [-2 -1 0 2 -1 0 0 1.5 0]",
        "Sphere 1 -1 1 360", "Rotate 70 1 0 0 Cylinder 1 -1 1 360",
        "Patch \"bicubic\" \"P\" [-3 -3 0 -1 -3 2 1 -3 -2 3 -3 0  -3 -1 2 -1 -1 3 1 -1 0 3 -1 2 "
        " -3 1 0 -1 1 -3 1 1 3 3 1 0  -3 3 0 -1 3 2 1 3 -2 3 3 0]"}) {
    SCOPED_TRACE(shape);
    RayScene s(world(std::string("Translate 0 0 6 ") + shape));
    for (float x : {-0.31f, 0.0f, 0.27f, 0.4f})
      for (float y : {-0.6f, 0.1f, 0.55f}) {
        TestRay ray{{x, y, 0}};
        auto P = s.value(ray, "primitive:P", Type::kPoint);
        ASSERT_EQ(P.size(), 3u);
        EXPECT_NEAR(P[0], x, 3e-3f);
        EXPECT_NEAR(P[1], y, 3e-3f);
        auto I = s.value(ray, "primitive:I", Type::kVector);
        EXPECT_NEAR(I[2], P[2], 1e-5f) << "from the ray's origin";
      }
  }
}

TEST(Trace, variables_of_the_primitive) {
  RayScene s(world("Translate 0 0 2 Color .2 .4 .6 Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] "
                   "\"varying float heat\" [0 1 1 0] \"constant string mark\" [\"here\"] "
                   "\"uniform float[2] pair\" [3 4] "),
             {});
  TestRay ray{{0.5f, -0.25f, 0}};
  EXPECT_THAT(s.value(ray, "primitive:heat", Type::kFloat), ElementsAre(FloatNear(0.75f, 1e-5f)));
  EXPECT_THAT(s.value(ray, "primitive:s", Type::kFloat), ElementsAre(FloatNear(0.5f, 1e-5f))) << "object x";
  EXPECT_THAT(s.value(ray, "primitive:Cs", Type::kColor), ElementsAre(0.2f, 0.4f, 0.6f));
  EXPECT_THAT(s.value(ray, "primitive:N", Type::kNormal), ElementsAre(0, 0, ::testing::Ne(0)));
  EXPECT_THAT(s.value(ray, "primitive:N", Type::kVector), ::testing::SizeIs(3))
      << "any three numbers will do";
  EXPECT_THAT(s.value(ray, "primitive:heat", Type::kColor), IsEmpty()) << "another type";
  EXPECT_THAT(s.value(ray, "primitive:cold", Type::kFloat), IsEmpty());
  EXPECT_THAT(s.value(ray, "primitive:pair", Type::kFloat), IsEmpty()) << "an array";
  auto mark = s.value(ray, "primitive:mark", Type::kString);
  ASSERT_EQ(mark.size(), 1u);
  EXPECT_EQ(s.machine().strings().text(std::bit_cast<uint32_t>(mark[0])), "here");
  slvm::RayOutput pair = RayScene::output(slvm::RayOutput::From::kPrimitive, "pair", Type::kFloat);
  pair.elements = 2;
  EXPECT_THAT(s.trace({ray}, {pair})[0].values[0], ElementsAre(3, 4));
  EXPECT_THAT(s.value({{5, 5, 0}}, "primitive:heat", Type::kFloat), IsEmpty()) << "a miss";
}

TEST(Trace, hits_run_displacement_surface_and_atmosphere) {
  RayScene s(
      world("Surface \"tint\" Displacement \"shift\" Atmosphere \"haze\" Attribute \"user\" \"float tag\" 7 "
            "Color .5 .5 .5 Translate 0 0 4 Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]"),
      {{"tint", "surface tint(output varying float mine = 0) { mine = s; Ci = Cs * color(1,0,0); Oi = .5; }"},
       {"shift", "displacement shift(output varying float moved = 0) { moved = 1; N = vector(1, 0, 0); }"},
       {"haze", "volume haze() { Ci = mix(Ci, color(0,0,1), .5); }"}});
  EXPECT_EQ(s.messages(), "");
  TestRay ray{{0.25f, 0.5f, 0}};
  EXPECT_THAT(s.value(ray, "surface:mine", Type::kFloat), ElementsAre(FloatNear(0.25f, 1e-5f)));
  EXPECT_THAT(s.value(ray, "surface:Ci", Type::kColor), ElementsAre(0.5f, 0, 0)) << "before the atmosphere";
  EXPECT_THAT(s.value(ray, "surface:Oi", Type::kColor), ElementsAre(0.5f, 0.5f, 0.5f));
  EXPECT_THAT(s.value(ray, "shaded:Ci", Type::kColor), ElementsAre(0.25f, 0, 0.5f)) << "after it";
  EXPECT_THAT(s.value(ray, "volume:Ci", Type::kColor), ElementsAre(0.25f, 0, 0.5f));
  EXPECT_THAT(s.value(ray, "displacement:moved", Type::kFloat), ElementsAre(1));
  EXPECT_THAT(s.value(ray, "surface:N", Type::kNormal), ElementsAre(1, 0, 0))
      << "as the displacement left it";
  EXPECT_THAT(s.value(ray, "primitive:N", Type::kNormal), ElementsAre(0, 0, ::testing::Ne(0)));
  EXPECT_THAT(s.value(ray, "attribute:user:tag", Type::kFloat), ElementsAre(7));
  slvm::RayOptions unshaded;
  unshaded.shades = false;
  EXPECT_THAT(s.value(ray, "surface:Ci", Type::kColor, unshaded), IsEmpty());
  EXPECT_THAT(s.value(ray, "primitive:s", Type::kFloat, unshaded), ElementsAre(FloatNear(0.25f, 1e-5f)));
}

TEST(Trace, shaders_run_only_where_something_of_theirs_is_asked_for) {
  RayScene s(world("Surface \"says\" Translate 0 0 4 Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]"),
             {{"says", "surface says() { printf(\"ran\\n\"); Ci = 1; }"}});
  const TestRay ray{{0.1f, 0.2f, 0}};
  EXPECT_FLOAT_EQ(s.distance(ray), 4);
  EXPECT_THAT(s.value(ray, "primitive:N", Type::kNormal), ::testing::SizeIs(3));
  slvm::RayOptions unshaded, plain;
  unshaded.shades = false;
  EXPECT_THAT(s.value(ray, "surface:N", Type::kNormal, unshaded), IsEmpty());
  plain.mode = slvm::HitMode::kPrimitive;
  EXPECT_THAT(s.value(ray, "surface:Ci", Type::kColor, plain), ElementsAre(1, 1, 1));
  EXPECT_EQ(s.transmission({}, {0, 0, 9}), Color(0.0f));
  EXPECT_EQ(s.printed(), "");
  EXPECT_THAT(s.value(ray, "surface:N", Type::kNormal), ::testing::SizeIs(3));
  EXPECT_EQ(s.printed(), "ran\n");
}

TEST(Trace, messages_come_from_shaders_of_the_same_object) {
  // Hits that follow each other in one context: what the first object's shaders left must not be found by the
  // second one, which has none of these.
  RayScene s(world("Surface \"ask\" TransformBegin Displacement \"lift\" Atmosphere \"haze\" "
                   "Polygon \"P\" [-3 -1 4 -1 -1 4 -1 1 4 -3 1 4] TransformEnd "
                   "AttributeBegin Displacement \"null\" Atmosphere \"null\" "
                   "Polygon \"P\" [1 -1 4 3 -1 4 3 1 4 1 1 4] AttributeEnd"),
             {{"ask", "surface ask(output varying float a = 0, b = 0) { float x = 0, y = 0;"
                      " a = displacement(\"height\", x); a += x; b = atmosphere(\"depth\", y); b += y; }"},
              {"lift", "displacement lift(output varying float height = 0) { height = 5; }"},
              {"haze", "volume haze(float depth = 7) { Ci *= 2; }"}});
  EXPECT_EQ(s.messages(), "");
  TestRay with{{-2, 0.1f, 0}}, without{{2, 0.1f, 0}};
  for (int i = 0; i < 3; ++i) {
    auto hits =
        s.trace({with, without}, {RayScene::output(slvm::RayOutput::From::kSurface, "a", Type::kFloat),
                                  RayScene::output(slvm::RayOutput::From::kSurface, "b", Type::kFloat)});
    EXPECT_THAT(hits[0].values[0], ElementsAre(6));
    EXPECT_THAT(hits[0].values[1], ElementsAre(8));
    EXPECT_THAT(hits[1].values[0], ElementsAre(0));
    EXPECT_THAT(hits[1].values[1], ElementsAre(0));
  }
}

TEST(Trace, volumes_of_the_side_that_is_hit) {
  // The ray comes from no surface with volumes of its own.
  const std::map<std::string, std::string> shaders = {
      {"white", "surface white() { Ci = 1; }"},
      {"fog", "volume fog(float k = 1) { Ci *= exp(-k * length(I)); }"},
      {"haze", "volume haze() { Ci = color(0, 0, 1); }"}};
  const std::string both = "Surface \"white\" Interior \"fog\" \"k\" .5 Exterior \"fog\" \"k\" .25 ";
  RayScene s(world(both + "Translate 0 0 5 Sphere 1 -1 1 360"), shaders);
  EXPECT_EQ(s.messages(), "");
  const TestRay inside{{0, 0, 5}}, outside{};
  auto red = [&](const TestRay& ray, const std::string& what) {
    auto v = s.value(ray, what, Type::kColor);
    return v.empty() ? -1.0f : v[0];
  };
  EXPECT_NEAR(red(inside, "shaded:Ci"), std::exp(-.5f), 1e-3f);
  EXPECT_NEAR(red(inside, "volume:Ci"), std::exp(-.5f), 1e-3f);
  EXPECT_NEAR(red(inside, "interior:Ci"), std::exp(-.5f), 1e-3f);
  EXPECT_EQ(red(inside, "exterior:Ci"), -1);
  EXPECT_EQ(red(inside, "surface:Ci"), 1) << "before any volume";
  EXPECT_NEAR(red(outside, "shaded:Ci"), std::exp(-1.0f), 1e-3f);
  EXPECT_NEAR(red(outside, "exterior:Ci"), std::exp(-1.0f), 1e-3f);
  EXPECT_EQ(red(outside, "atmosphere:Ci"), -1);
  // Turned inside out.
  RayScene turned(world("ReverseOrientation " + both + "Translate 0 0 5 Sphere 1 -1 1 360"), shaders);
  EXPECT_NEAR(turned.value(inside, "shaded:Ci", Type::kColor)[0], std::exp(-.25f), 1e-3f);
  // Hits from both sides in one batch, and an atmosphere where there is no volume.
  RayScene mixed(world("Surface \"white\" Interior \"fog\" Atmosphere \"haze\" Translate 0 0 5 "
                       "Sphere 1 -1 1 360"),
                 shaders);
  auto out = mixed.trace({inside, outside, inside},
                         {RayScene::output(slvm::RayOutput::From::kShaded, "Ci", Type::kColor),
                          RayScene::output(slvm::RayOutput::From::kAtmosphere, "Ci", Type::kColor)});
  EXPECT_NEAR(out[0].values[0][0], std::exp(-1.0f), 1e-3f);
  EXPECT_THAT(out[1].values[0], ElementsAre(0, 0, 1));
  EXPECT_NEAR(out[2].values[0][0], std::exp(-1.0f), 1e-3f);
  EXPECT_THAT(out[0].values[1], IsEmpty());
  EXPECT_THAT(out[1].values[1], ElementsAre(0, 0, 1));
}

TEST(Trace, what_the_shader_of_a_hit_is_told) {
  RayScene s(world("Surface \"tell\" Translate 0 0 4 Polygon \"P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]"),
             {{"tell", "surface tell(output varying float facts[3] = {0,0,0}; output varying color where = 0;"
                       " output varying float far = 0) {"
                       "uniform float d = 0; uniform string l = \"\", t = \"\"; rayinfo(\"depth\", d);"
                       "rayinfo(\"label\", l); rayinfo(\"type\", t); facts[0] = d;"
                       "if (l == \"mine\") facts[1] = 1; if (t == \"diffuse\") facts[2] = 1;"
                       "point o; rayinfo(\"origin\", o); where = color(xcomp(o), ycomp(o), zcomp(o));"
                       "rayinfo(\"length\", far); }"}});
  EXPECT_EQ(s.messages(), "");
  slvm::RayOptions o;
  o.kind = RayKind::kDiffuse;
  o.label = "mine";
  slvm::RayOutput facts = RayScene::output(slvm::RayOutput::From::kSurface, "facts", Type::kFloat);
  facts.elements = 3;
  TestRay ray{{0.5f, -0.5f, 1}, {0, 0.1f, 1}};
  EXPECT_THAT(s.trace({ray}, {facts}, o)[0].values[0], ElementsAre(1, 1, 1));
  EXPECT_THAT(s.value(ray, "surface:where", Type::kColor),
              ElementsAre(FloatNear(0.5f, 1e-4f), FloatNear(-0.5f, 1e-4f), FloatNear(1, 1e-4f)));
  EXPECT_THAT(s.value(ray, "surface:far", Type::kFloat), ElementsAre(FloatNear(3 * std::sqrt(1.01f), 1e-4f)));
}

TEST(Trace, the_eye_of_a_hit_is_where_its_ray_comes_from) {
  // E is uniform; rays from different places must not share it.
  RayScene s(world("Surface \"eye\" Translate 0 0 4 Polygon \"P\" [-3 -3 0 3 -3 0 3 3 0 -3 3 0]"),
             {{"eye", "surface eye(output varying float x = 0) { x = xcomp(E); }"}});
  std::vector<TestRay> rays;
  for (int i = 0; i < 40; ++i)
    rays.push_back({{0.1f * static_cast<float>(i / 2) - 1, 0, 0}});
  auto hits = s.trace(rays, {RayScene::output(slvm::RayOutput::From::kSurface, "x", Type::kFloat)});
  for (size_t i = 0; i < rays.size(); ++i)
    EXPECT_THAT(hits[i].values[0], ElementsAre(FloatNear(rays[i].origin.x, 1e-6f)));
}

TEST(Trace, visibility_by_kind_of_ray) {
  struct Case {
    const char* attribute;
    bool specular, diffuse, transmission;
  };
  for (Case c :
       {Case{"", false, false, false}, Case{"Attribute \"visibility\" \"trace\" 1", true, true, false},
        Case{"Attribute \"visibility\" \"int specular\" 1", true, false, false},
        Case{"Attribute \"visibility\" \"int diffuse\" 1", false, true, false},
        Case{"Attribute \"visibility\" \"transmission\" \"opaque\"", false, false, true},
        Case{"Attribute \"visibility\" \"transmission\" \"transparent\"", false, false, false},
        Case{"Attribute \"visibility\" \"int transmission\" 1", false, false, true},
        Case{"Attribute \"visibility\" \"trace\" 1 Attribute \"visibility\" \"int diffuse\" 0", true, false,
             false}}) {
    SCOPED_TRACE(c.attribute);
    RayScene s(std::string("WorldBegin ") + c.attribute + " Translate 0 0 4 Disk 0 2 360 WorldEnd");
    EXPECT_EQ(s.messages(), "");
    slvm::RayOptions o;
    EXPECT_EQ(s.distance({{0.1f, 0.1f, 0}}, o) < 10, c.specular);
    o.kind = RayKind::kDiffuse;
    EXPECT_EQ(s.distance({{0.1f, 0.1f, 0}}, o) < 10, c.diffuse);
    EXPECT_EQ(s.transmission({0.1f, 0.1f, 0}, {0.1f, 0.1f, 9}) == Color(0.0f), c.transmission);
  }
}

TEST(Trace, subsets_of_groups) {
  std::string rib;
  for (const char* groups : {"", "a", "a,b", "b"})
    rib += std::string("Attribute \"grouping\" \"string membership\" [\"") + groups +
           "\"] Translate 0 0 2 Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] ";
  RayScene s(world(rib));
  EXPECT_EQ(s.messages(), "");
  auto first = [&](std::string_view subset) {
    slvm::RayOptions o;
    o.subset = subset;
    return s.distance({}, o);
  };
  EXPECT_EQ(first(""), 2);
  EXPECT_EQ(first("a"), 4);
  EXPECT_EQ(first("b"), 6);
  EXPECT_EQ(first("b a"), 4);
  EXPECT_EQ(first("-a"), 2);
  EXPECT_EQ(first("b,-a"), 8);
  EXPECT_EQ(first("c"), kInfinity);
}

TEST(Trace, groups_are_joined_and_left) {
  RayAttributes a;
  auto set = [&](const char* text) {
    EXPECT_EQ(set_ray_attribute(a, "grouping", "membership", {Type::kString, 0, {}, {text}}), "");
    return a.groups;
  };
  EXPECT_EQ(set("one, two"), "one two");
  EXPECT_EQ(set("+three -one"), "two three");
  EXPECT_EQ(set("four"), "four");
  EXPECT_EQ(set(""), "");
}

TEST(Trace, one_sided_surfaces_and_sides_of_rays) {
  for (bool reversed : {false, true})
    for (const char* shape :
         {"Disk 0 2 360", "Scale 1 1 -1 Disk 0 2 360", "ReverseOrientation Disk 0 2 360"}) {
      SCOPED_TRACE(shape);
      std::string place = std::string("Translate 0 0 4 ") + (reversed ? "Rotate 180 1 0 0 " : "") + shape;
      RayScene two(world(place)), one(world("Sides 1 " + place));
      auto N = two.value({{0.5f, 0.1f, 0}}, "primitive:N", Type::kNormal);
      bool faces = N[2] < 0;
      EXPECT_EQ(one.distance({{0.5f, 0.1f, 0}}) < 10, faces);
      EXPECT_EQ(one.distance({{0.5f, 0.1f, 8}, {0, 0, -1}}) < 10, !faces);
      slvm::RayOptions o;
      o.sides = slvm::HitSides::kFront;
      EXPECT_EQ(two.distance({{0.5f, 0.1f, 0}}, o) < 10, faces);
      o.sides = slvm::HitSides::kBack;
      EXPECT_EQ(two.distance({{0.5f, 0.1f, 0}}, o) < 10, !faces);
      EXPECT_EQ(one.distance({{0.5f, 0.1f, 0}}, o), kInfinity) << "its back is not there";
    }
}

TEST(Trace, depth_limits_of_the_objects_on_the_way) {
  RayScene s(
      world("Attribute \"trace\" \"int maxspeculardepth\" 3 \"int maxdiffusedepth\" 0 "
            "Translate 0 0 4 Disk 0 2 360 Attribute \"trace\" \"int maxspeculardepth\" 1 Disk 1 1 360"));
  auto shot = [&](int primitive, RayKind kind, const slvm::RayFacts& facts) {
    s.asking_grid(1, 1, primitive).ray = facts;
    slvm::RayOptions o;
    o.kind = kind;
    return s.distance({{0.1f, 0.1f, 0}}, o) != slvm::kNotShot;
  };
  slvm::RayFacts camera, second;
  second.type = "specular";
  second.depth = second.specular_depth = 2;
  second.most_specular_depth = 3;
  EXPECT_TRUE(shot(0, RayKind::kSpecular, camera));
  EXPECT_FALSE(shot(0, RayKind::kDiffuse, camera)) << "maxdiffusedepth 0";
  EXPECT_TRUE(shot(0, RayKind::kSpecular, second));
  second.most_specular_depth = 2;
  EXPECT_FALSE(shot(0, RayKind::kSpecular, second)) << "the limit of the object before";
  second.most_specular_depth = 9;
  EXPECT_TRUE(shot(1, RayKind::kSpecular, second)) << "one more from where it is";
  EXPECT_TRUE(shot(-1, RayKind::kDiffuse, camera)) << "1 by default";
  slvm::RayFacts diffuse;
  diffuse.type = "diffuse";
  diffuse.depth = diffuse.diffuse_depth = 1;
  EXPECT_FALSE(shot(-1, RayKind::kSpecular, diffuse)) << "no mirrors by the way of diffuse rays";
  slvm::RayFacts deep;
  deep.depth = 10;
  EXPECT_FALSE(shot(-1, RayKind::kSpecular, deep)) << "Option trace maxdepth";
}

TEST(Trace, rays_that_weigh_too_little_are_not_shot) {
  RayScene s("Option \"trace\" \"float minweight\" 0.1 " + world("Translate 0 0 4 Disk 0 2 360"));
  EXPECT_EQ(s.messages(), "");
  float half[1] = {0.15f}, tenth[1] = {0.05f};
  slvm::Grid& grid = s.asking_grid();
  for (auto& w : grid.ray.weight)
    w = half;
  EXPECT_NEAR(s.distance({{0.1f, 0.1f, 0}}), 4, 1e-5f);
  for (auto& w : grid.ray.weight)
    w = tenth;
  EXPECT_EQ(s.distance({{0.1f, 0.1f, 0}}), slvm::kNotShot);
}

TEST(Trace, rays_that_are_not_shot_leave_others_their_hits) {
  RayScene s("Option \"trace\" \"float minweight\" 0.1 " + world("Translate 0 0 4 Disk 0 9 360"));
  s.asking_grid();
  constexpr size_t kRays = 150;                 // more than are looked up together
  for (size_t last : {kRays - 1, size_t{70}}) { // the last one that is shot
    std::vector<float> zero(kRays, 0.0f), one(kRays, 1.0f), x(kRays), weight(kRays, 0.01f),
        depth(kRays, -1.0f), distance(kRays);
    std::vector<uint32_t> number(kRays);
    for (size_t i = 0; i < kRays; ++i) {
      x[i] = 0.01f * static_cast<float>(i);
      number[i] = static_cast<uint32_t>(i);
      if (i <= last && i % 3 != 1) weight[i] = 1;
    }
    slvm::RayBatch batch;
    batch.count = kRays;
    batch.origin[0] = x.data();
    batch.origin[1] = batch.origin[2] = batch.direction[0] = batch.direction[1] = zero.data();
    batch.direction[2] = one.data();
    for (auto& w : batch.weight)
      w = weight.data();
    batch.sample = number.data();
    std::vector<uint32_t> point(kRays, 0);
    batch.point = point.data();
    std::vector<float> P(3 * kRays, -1.0f);
    slvm::RayOutput out = RayScene::output(slvm::RayOutput::From::kPrimitive, "P", Type::kPoint);
    out.data = P.data();
    out.pitch = kRays;
    s.tracer().trace(s.state(), {}, batch, {&out, 1}, distance.data(), nullptr);
    for (size_t i = 0; i < kRays; ++i) {
      const bool shot = weight[i] == 1;
      EXPECT_NEAR(distance[i], shot ? 4 : slvm::kNotShot, 1e-5f) << i;
      EXPECT_NEAR(P[i], shot ? x[i] : -1, 1e-3f) << i;
    }
  }
}

TEST(Trace, where_no_distance_is_wanted_any_hit_will_do) {
  RayScene s("Option \"trace\" \"float minweight\" 0.1 " +
             world("Translate 0 0 4 Disk 0 2 360 Sides 1 Translate 0 0 1 Disk 0 3 360 ReverseOrientation "
                   "Translate 0 0 1 Disk 0 4 360"));
  slvm::RayOptions any;
  any.wants_distance = false;
  std::vector<TestRay> rays;
  for (float x : {0.5f, 1.9f, 2.1f, 2.9f, 3.1f, 3.9f, 4.1f})
    for (float limit : {3.5f, 4.5f, 5.5f, 7.0f, kInfinity})
      for (float z : {0.0f, 10.0f})
        rays.push_back({{x, 0.1f, z}, {0, 0, z > 0 ? -1.0f : 1.0f}, limit});
  const auto with = s.trace(rays), without = s.trace(rays, {}, any);
  size_t hits = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    hits += with[i].distance < kInfinity;
    EXPECT_EQ(without[i].distance, with[i].distance < kInfinity ? 0 : kInfinity) << i;
  }
  EXPECT_GT(hits, 10u);
  EXPECT_LT(hits, rays.size() - 10);
  // What else is asked decides as well.
  const TestRay ahead{{0.5f, 0.1f, 0}};
  EXPECT_NEAR(
      s.trace({ahead}, {RayScene::output(slvm::RayOutput::From::kPrimitive, "P", Type::kPoint)}, any)[0]
          .distance,
      4, 1e-5f);
  slvm::RayCursor cursor;
  EXPECT_NEAR(s.trace({ahead}, {}, any, &cursor)[0].distance, 4, 1e-5f);
  float light[1] = {0.05f};
  for (auto& w : s.asking_grid().ray.weight)
    w = light;
  EXPECT_EQ(s.distance(ahead, any), slvm::kNotShot);
}

TEST(Trace, cursors_find_one_surface_after_the_other) {
  // Cards, two of them in the same place; and rays through the edges between faces.
  RayScene two(world("Translate 0 0 2 Disk 0 3 360 Disk 2 3 360 Disk 2 3 360 Disk 5 3 360")),
      one(world("Translate 0 0 2 Disk 0 3 360 Disk 2 3 360 Disk 5 3 360"));
  for (float x : {0.3f, 0.0f}) {
    RayScene& s = x > 0 ? two : one;
    slvm::RayCursor cursor;
    std::vector<float> met;
    for (int i = 0; i < 9; ++i) {
      float d = s.trace({{{x, 1e-4f * x, 0}}}, {}, {}, &cursor)[0].distance;
      if (d == kInfinity) break;
      met.push_back(d);
    }
    std::vector<float> expected = x > 0 ? std::vector<float>{2, 4, 4, 7} : std::vector<float>{2, 4, 7};
    EXPECT_THAT(met, ::testing::Pointwise(FloatNear(1e-5f), expected)) << x;
  }
}

TEST(Trace, default_surface_and_primitive_mode) {
  RayScene s(world("Color .5 .5 1 Opacity .5 .5 .5 Translate 0 0 4 Disk 0 2 360"));
  slvm::RayOptions o;
  EXPECT_THAT(s.value({{0.1f, 0.1f, 0}}, "surface:Ci", Type::kColor),
              ElementsAre(FloatNear(.25f, 1e-3f), FloatNear(.25f, 1e-3f), FloatNear(.5f, 1e-3f)));
  o.mode = slvm::HitMode::kPrimitive;
  EXPECT_THAT(s.value({{0.1f, 0.1f, 0}, {0.3f, 0, 1}}, "surface:Ci", Type::kColor, o),
              ElementsAre(.25f, .25f, .5f));
}

TEST(Trace, messages_about_attributes) {
  RayScene s("WorldBegin Attribute \"visibility\" \"string transmission\" [\"glass\"] "
             "Attribute \"shade\" \"string diffusehitmode\" [\"none\"] "
             "Attribute \"trace\" \"float bias\" -1 WorldEnd");
  EXPECT_THAT(s.messages(),
              ::testing::HasSubstr("Attribute: \"transmission\" is \"transparent\", \"opaque\", \"Os\", "
                                   "\"shader\", 0 or 1"));
  EXPECT_THAT(s.messages(),
              ::testing::HasSubstr("Attribute: \"diffusehitmode\" is \"primitive\" or \"shader\""));
  EXPECT_THAT(s.messages(), ::testing::HasSubstr("Attribute: \"bias\" takes one number, 0 or more"));
}

// ---- Constructed solids.

std::string part(const std::string& rib) {
  return "SolidBegin \"primitive\" TransformBegin " + rib + " TransformEnd SolidEnd ";
}
std::string solid(const std::string& operation, const std::string& parts) {
  return world(
      "Opacity .5 .5 .5 Attribute \"visibility\" \"transmission\" \"Os\" Translate 0 0 5 SolidBegin \"" +
      operation + "\" " + parts + "SolidEnd");
}

TEST(SolidRays, a_ball_cut_out_of_a_ball) {
  // Radius 2 about z = 5 without radius 1 about z = 3.
  RayScene s(solid("difference", part("Sphere 2 -2 2 360") + part("Translate 0 0 -2 Sphere 1 -1 1 360")));
  EXPECT_EQ(s.messages(), "");
  EXPECT_NEAR(s.distance({}), 4, 3e-3f) << "the bottom of the hole";
  EXPECT_NEAR(s.distance({{1.5f, 0, 0}}), 5 - std::sqrt(1.75f), 3e-3f) << "beside the hole";
  EXPECT_NEAR(s.distance({{0, 0, 4.5f}}), 2.5f, 3e-3f) << "from inside";
  EXPECT_NEAR(s.distance({{0, 0, 4.5f}, {0, 0, -1}}), .5f, 3e-3f);
  EXPECT_NEAR(s.distance({{0, 0, 3.5f}}), .5f, 3e-3f) << "in the hole";
  EXPECT_EQ(s.distance({{0, 0, 3.5f}, {0, 0, -1}}), kInfinity) << "out of the hole";
  EXPECT_NEAR(s.distance({{}, {0, 0, 1}, kInfinity, 4.5f}), 7, 3e-3f) << "behind the bias";
  EXPECT_EQ(s.distance({{}, {0, 0, 1}, 3.5f}), kInfinity) << "maxdist";
  EXPECT_NEAR(s.transmission(Vec3(0.0f), {0, 0, 9})[0], .25f, 1e-5f);
  EXPECT_NEAR(s.transmission(Vec3(0.0f), {0, 0, 6})[0], .5f, 1e-5f);
}

TEST(SolidRays, what_two_balls_have_in_common) {
  RayScene s(solid("intersection", part("Sphere 1 -1 1 360") + part("Translate 0 0 1 Sphere 1 -1 1 360")));
  EXPECT_NEAR(s.distance({}), 5, 3e-3f);
  EXPECT_NEAR(s.distance({{0, 0, 5.5f}}), .5f, 3e-3f);
  EXPECT_EQ(s.distance({{0.9f, 0, 0}}), kInfinity) << "the lens has a radius of sqrt(3/4)";
  EXPECT_LT(s.distance({{0.85f, 0, 0}}), 6);
}

TEST(SolidRays, a_union_has_no_surface_inside) {
  RayScene s(solid("union", part("Sphere 1 -1 1 360") + part("Translate 0 0 1 Sphere 1 -1 1 360")));
  EXPECT_NEAR(s.distance({}), 4, 3e-3f);
  EXPECT_NEAR(s.distance({{0, 0, 4.5f}}), 2.5f, 3e-3f);
  EXPECT_NEAR(s.transmission(Vec3(0.0f), {0, 0, 9})[0], .25f, 1e-5f) << "in and out once";
  slvm::RayCursor cursor;
  std::vector<float> met;
  for (int i = 0; i < 5; ++i)
    if (float d = s.trace({TestRay{}}, {}, {}, &cursor)[0].distance; d < kInfinity) met.push_back(d);
  EXPECT_THAT(met, ElementsAre(FloatNear(4, 3e-3f), FloatNear(7, 3e-3f))) << "traverse()";
}

TEST(SolidRays, surfaces_are_seen_each_as_its_attributes_say) {
  const std::string ball = part("Sphere 2 -2 2 360"), hole = "Translate 0 0 -2 Sphere 1 -1 1 360";
  // What rays do not see cuts all the same: they go through where it has cut, to the far side.
  RayScene unseen(solid("difference", ball + part("Attribute \"visibility\" \"trace\" 0 \"transmission\" "
                                                  "\"transparent\" " +
                                                  hole)));
  EXPECT_NEAR(unseen.distance({}), 7, 3e-3f);
  EXPECT_NEAR(unseen.distance({{1.5f, 0, 0}}), 5 - std::sqrt(1.75f), 3e-3f);
  EXPECT_NEAR(unseen.transmission(Vec3(0.0f), {0, 0, 9})[0], .5f, 1e-5f);
  // Groups.
  RayScene grouped(
      solid("difference", ball + part("Attribute \"grouping\" \"string membership\" \"holes\" " + hole)));
  slvm::RayOptions options;
  options.subset = "holes";
  EXPECT_NEAR(grouped.distance({}, options), 4, 3e-3f);
  EXPECT_EQ(grouped.distance({{1.5f, 0, 0}}, options), kInfinity);
  options.subset = "-holes";
  EXPECT_NEAR(grouped.distance({}, options), 7, 3e-3f);
  // Sides, by the normals that the surfaces have: rays come to the hole from its inside.
  RayScene sided(solid("difference", ball + part("Sides 1 " + hole)));
  EXPECT_NEAR(sided.distance({}), 7, 3e-3f);
  EXPECT_NEAR(sided.distance({{0, 0, 4.5f}, {0, 0, -1}}), .5f, 3e-3f);
  options = {};
  options.sides = slvm::HitSides::kFront;
  EXPECT_EQ(RayScene(solid("difference", ball + part(hole))).distance({}, options), kInfinity);
}

} // namespace
} // namespace render::testing
