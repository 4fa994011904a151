// Footprints of rays where they hit, and the neighbours that derivatives at hits are taken from: compared
// with what neighbouring rays really hit.
#include "render/rays/hit_grid.h"
#include "tests/render/rays/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

const std::string kSeen = "Attribute \"visibility\" \"trace\" 1 ";

/// A ray leaving `origin` after the mirror turned it, and the same for the neighbours in x and y.
struct RayFan {
  Vec3 origin, direction, origin_dx, origin_dy, direction_dx, direction_dy;
};

/// Camera rays through pixels 1/100 apart, mirrored by a plane z = 5 whose normal is turned in x and y.
RayFan plane_mirror(float x, float y) {
  Vec3 n = glm::normalize(Vec3(0.2f, 0.1f, -1));
  auto reflected = [&](float px, float py) {
    Vec3 d(px, py, 1);
    float t = glm::dot(Vec3(0, 0, 5), n) / glm::dot(d, n);
    return std::pair(d * t, glm::normalize(glm::reflect(d, n)));
  };
  auto [p, d] = reflected(x, y);
  auto [px, dx] = reflected(x + 0.01f, y);
  auto [py, dy] = reflected(x, y + 0.01f);
  return {p, d, px - p, py - p, dx - d, dy - d};
}

/// The same by a sphere of radius 1 about (0, 0, 5).
RayFan sphere_mirror(float x, float y, float step) {
  auto reflected = [&](float px, float py) {
    glm::dvec3 d = glm::normalize(glm::dvec3(px, py, 1)), c(0, 0, 5);
    double b = glm::dot(d, c), t = b - std::sqrt(b * b - glm::dot(c, c) + 1);
    glm::dvec3 p = d * t;
    return std::pair(p, glm::normalize(glm::reflect(d, p - c)));
  };
  auto [p, d] = reflected(x, y);
  auto [px, dx] = reflected(x + step, y);
  auto [py, dy] = reflected(x, y + step);
  return {Vec3(p), Vec3(d), Vec3(px - p), Vec3(py - p), Vec3(dx - d), Vec3(dy - d)};
}

/// Rays that are all the same, in the form the renderer has them in.
struct FanBatch {
  explicit FanBatch(const RayFan& fan, size_t count = 1) {
    const Vec3 from[] = {fan.origin,    fan.direction,    fan.origin_dx,
                         fan.origin_dy, fan.direction_dx, fan.direction_dy};
    for (size_t k = 0; k < 6; ++k)
      for (int c = 0; c < 3; ++c)
        planes[k][c].assign(count, from[k][c]);
    batch.count = count;
    for (int c = 0; c < 3; ++c) {
      batch.origin[c] = planes[0][c].data();
      batch.direction[c] = planes[1][c].data();
      batch.origin_du[c] = planes[2][c].data();
      batch.origin_dv[c] = planes[3][c].data();
      batch.direction_du[c] = planes[4][c].data();
      batch.direction_dv[c] = planes[5][c].data();
    }
  }
  std::vector<float> planes[6][3];
  slvm::RayBatch batch;
  HitRays rays{batch, {}};
};

HitRay hit_of(RayScene& s, const RayFan& fan) {
  HitRay hit;
  hit.distance = s.distance({fan.origin, fan.direction});
  return hit;
}

/// A wall behind the eye, z = -2, 40 wide and high; u and v are along x and y.
const std::string kWall =
    "WorldBegin " + kSeen + "Patch \"bilinear\" \"P\" [-20 -20 -2 20 -20 -2 -20 20 -2 20 20 -2] WorldEnd";

void expect_footprint(RayScene& s, const RayFan& fan, float tolerance) {
  HitRay hit = hit_of(s, fan);
  ASSERT_LT(hit.distance, 1000);
  auto uv_on_wall = [](Vec3 origin, Vec3 direction) {
    Vec3 p = origin + direction * ((-2 - origin.z) / direction.z);
    return Vec2((p.x + 20) / 40, (p.y + 20) / 40);
  };
  Vec2 at = uv_on_wall(fan.origin, fan.direction);
  // All of the wall's space is camera space.
  Footprint f = footprint_on(FanBatch(fan).rays, hit, {Vec3(at * 40.0f - 20.0f, -2), {40, 0, 0}, {0, 40, 0}});
  Vec2 x = uv_on_wall(fan.origin + fan.origin_dx, glm::normalize(fan.direction + fan.direction_dx)) - at;
  Vec2 y = uv_on_wall(fan.origin + fan.origin_dy, glm::normalize(fan.direction + fan.direction_dy)) - at;
  float size = std::max({std::abs(x.x), std::abs(x.y), std::abs(y.x), std::abs(y.y)});
  EXPECT_NEAR(f.ux, x.x, tolerance * size);
  EXPECT_NEAR(f.vx, x.y, tolerance * size);
  EXPECT_NEAR(f.uy, y.x, tolerance * size);
  EXPECT_NEAR(f.vy, y.y, tolerance * size);
}

TEST(Footprint, of_plane_mirrors) {
  RayScene s(kWall);
  for (float x : {-0.3f, 0.0f, 0.2f})
    for (float y : {-0.2f, 0.1f})
      expect_footprint(s, plane_mirror(x, y), 0.02f);
}

TEST(Footprint, of_sphere_mirrors) {
  RayScene s(kWall);
  for (float x : {-0.06f, 0.01f, 0.08f})
    for (float y : {-0.05f, 0.07f})
      expect_footprint(s, sphere_mirror(x, y, 1e-4f), 0.02f);
}

TEST(Geometry, points_in_pairs_are_those_of_lattices) {
  RayScene s(
      "WorldBegin " + kSeen +
      "Sphere 1 -.5 .8 300 Torus 2 .5 0 300 270 Paraboloid 1 .2 1 360 Hyperboloid 1 0 0 1 1 1 360 Disk 0 1 "
      "360 "
      "Patch \"bilinear\" \"P\" [0 0 0 2 0 0 0 1 1 2 2 0] "
      "Patch \"bicubic\" \"P\" [-3 -3 0 -1 -3 2 1 -3 -2 3 -3 0  -3 -1 2 -1 -1 3 1 -1 0 3 -1 2 "
      "-3 1 0 -1 1 -3 1 1 3 3 1 0  -3 3 0 -1 3 2 1 3 -2 3 3 0] "
      "NuPatch 3 3 [0 0 0 1 1 1] 0 1 3 3 [0 0 0 1 1 1] 0 1 "
      "\"Pw\" [0 0 0 1 1 0 1 2 2 0 0 1  0 1 1 1 1 1 0 1 2 1 1 1  0 2 0 1 1 2 1 1 2 2 0 3] "
      "PointsPolygons [3 4] [0 1 2 2 1 3 4] \"P\" [0 0 0 1 0 0 0 1 0 2 0 1 1 1 1] "
      "SubdivisionMesh \"catmull-clark\" [4 4] [0 1 4 3 1 2 5 4] [\"interpolateboundary\"] [0 0] [] [] "
      "\"P\" [0 0 0 1 0 0 2 0 1 0 1 0 1 1 1 2 1 0] "
      "Curves \"cubic\" [4] \"nonperiodic\" \"P\" [0 0 0 1 1 0 2 0 1 3 1 0] \"constantwidth\" [.2] "
      "Points \"P\" [0 0 0 1 1 1] WorldEnd");
  ASSERT_EQ(s.messages(), "");
  std::vector<float> u, v, pair_u, pair_v;
  for (int i = 0; i < 11; ++i) {
    u.push_back(static_cast<float>(i) / 10);
    v.push_back(static_cast<float>(10 - i) / 10);
  }
  for (float b : v)
    for (float a : u) {
      pair_u.push_back(a);
      pair_v.push_back(b);
    }
  size_t kinds = 0;
  for (const Primitive& p : s.scene().primitives) {
    SurfaceLattice lattice, pairs;
    p.geometry->evaluate({u, v}, lattice);
    p.geometry->evaluate({pair_u, pair_v, true}, pairs);
    ASSERT_EQ(lattice.P.size(), pairs.P.size());
    ++kinds;
    for (size_t k = 0; k < pairs.P.size(); ++k) {
      EXPECT_LT(glm::distance(lattice.P[k], pairs.P[k]), 1e-5f) << kinds << ' ' << k;
      EXPECT_LT(glm::distance(lattice.N[k], pairs.N[k]), 1e-4f) << kinds << ' ' << k;
      EXPECT_LT(glm::distance(lattice.dPdu[k], pairs.dPdu[k]), 1e-4f) << kinds << ' ' << k;
      EXPECT_LT(glm::distance(lattice.dPdv[k], pairs.dPdv[k]), 1e-4f) << kinds << ' ' << k;
    }
  }
  EXPECT_GE(kinds, 12u);
}

TEST(HitGrid, neighbours_lie_where_neighbouring_rays_hit) {
  RayScene s("WorldBegin " + kSeen + "Translate 0 0 -6 Rotate 20 1 1 0 Sphere 3 -3 3 360 WorldEnd");
  RayFan fan = sphere_mirror(0.01f, -0.02f, 2e-4f);
  HitRay hit = hit_of(s, fan);
  ASSERT_LT(hit.distance, 100);
  // Where on the sphere: by its own trace.
  TestRay ray{fan.origin, fan.direction};
  hit.place.u = s.value(ray, "primitive:u", slvm::Type::kFloat)[0];
  hit.place.v = s.value(ray, "primitive:v", slvm::Type::kFloat)[0];
  Camera camera(s.scene().options);
  DiceContext context{&camera, &s.machine().strings(), 0, 0};
  HitGrid hits;
  std::vector<HitRay> list(3, hit);
  FanBatch batch(fan, 3);
  hits.dice(s.scene(), batch.rays, list, true, context);
  slvm::Grid& g = hits.grid;
  ASSERT_EQ(g.nu(), 3);
  ASSERT_EQ(g.nv(), 3);
  EXPECT_EQ(g.samples(), 3u);
  auto P = [&](size_t k) {
    const slvm::Planes& p = g.variable(slvm::Global::kP);
    return Vec3(p.get(0, k), p.get(1, k), p.get(2, k));
  };
  // One ray step along x is footprint[0] steps along u and footprint[1] along v.
  Vec3 along_u = P(3 + 1) - P(1), along_v = P(6 + 1) - P(1);
  Vec3 x = along_u * g.footprint[0][1] + along_v * g.footprint[1][1];
  Vec3 y = along_u * g.footprint[2][1] + along_v * g.footprint[3][1];
  auto hit_point = [&](Vec3 o, Vec3 d) {
    d = glm::normalize(d);
    glm::dvec3 c(0, 0, -6), oc = glm::dvec3(o) - c;
    double b = glm::dot(glm::dvec3(d), oc), t = -b - std::sqrt(b * b - glm::dot(oc, oc) + 9);
    return Vec3(glm::dvec3(o) + glm::dvec3(d) * t);
  };
  Vec3 here = hit_point(fan.origin, fan.direction);
  Vec3 true_x = hit_point(fan.origin + fan.origin_dx, fan.direction + fan.direction_dx) - here;
  Vec3 true_y = hit_point(fan.origin + fan.origin_dy, fan.direction + fan.direction_dy) - here;
  float size = glm::length(true_x) + glm::length(true_y);
  EXPECT_LT(glm::distance(P(1), here), 3e-3f);
  EXPECT_LT(glm::distance(x, true_x), 0.03f * size);
  EXPECT_LT(glm::distance(y, true_y), 0.03f * size);
  // Du(P) is the derivative by u: the step divided by du.
  float du = g.variable(slvm::Global::kdu).get(0, 1);
  const slvm::Planes& dPdu = g.variable(slvm::Global::kdPdu);
  Vec3 derivative(dPdu.get(0, 1), dPdu.get(1, 1), dPdu.get(2, 1));
  EXPECT_LT(glm::distance(along_u / du, derivative), 0.02f * glm::length(derivative));
}

TEST(HitGrid, derivatives_at_the_edges_of_a_surface) {
  // u = 1: the neighbour is looked for inside, and brought outside.
  RayScene s("WorldBegin " + kSeen + "Patch \"bilinear\" \"P\" [0 0 5 1 0 5 0 1 5 1 1 5] WorldEnd");
  Camera camera(s.scene().options);
  DiceContext context{&camera, &s.machine().strings(), 0, 0};
  HitRay hit;
  hit.place = {0, 1, 1, false};
  hit.distance = 5;
  FanBatch batch({{1, 1, 0}, {0, 0, 1}, {0.25f, 0, 0}, {0, 3, 0}, Vec3(0.0f), Vec3(0.0f)});
  HitGrid hits;
  hits.dice(s.scene(), batch.rays, {&hit, 1}, true, context);
  const slvm::Planes &u = hits.grid.variable(slvm::Global::ku), &v = hits.grid.variable(slvm::Global::kv);
  EXPECT_NEAR(u.get(0, 1), 1.25f, 1e-4f);
  EXPECT_NEAR(v.get(0, 2), 4, 1e-3f);
  EXPECT_NEAR(hits.grid.variable(slvm::Global::kdu).get(0, 0), 0.25f, 1e-4f);
  EXPECT_NEAR(hits.grid.variable(slvm::Global::kP).get(0, 1), 1.25f, 1e-4f);
}

TEST(HitGrid, variables_of_triangles_are_those_of_the_place) {
  // As far as to their corners, one of which is a side to u and v.
  RayScene s("WorldBegin " + kSeen +
             "Polygon \"P\" [-2 0 3 1 -1 3 0 5 3] \"varying float heat\" [-2 -1 10] WorldEnd"); // x + 2 y
  const Vec3 corners[] = {{-2, 0, 3}, {1, -1, 3}, {0, 5, 3}};
  std::vector<TestRay> rays;
  for (const Vec3& corner : corners)
    for (const Vec3& other : corners)
      for (float way : {1e-4f, 1e-3f, 0.03f, 0.3f}) {
        const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0f;
        const Vec3 to = corner + (0.9f * other + 0.1f * centre - corner) * way;
        rays.push_back({{0, 0, 0}, glm::mix(to, centre, 1e-6f)});
      }
  const auto hits =
      s.trace(rays, {RayScene::output(slvm::RayOutput::From::kPrimitive, "heat", slvm::Type::kFloat)});
  for (size_t k = 0; k < rays.size(); ++k) {
    const Vec3 there = rays[k].direction;
    ASSERT_EQ(hits[k].values.size(), 1u) << k;
    ASSERT_EQ(hits[k].values[0].size(), 1u) << k;
    EXPECT_NEAR(hits[k].values[0][0], there.x + 2 * there.y, 2e-3f) << k;
  }
}

TEST(HitGrid, neighbours_are_left_out_behind_the_last_derivative) {
  // The same shader, once with a derivative at its end that changes nothing; a light whose colour varies,
  // loops and conditions behind and in front of derivatives.
  auto shader = [](const std::string& name, const std::string& last) {
    return "surface " + name +
           "() { color c = 0; float d = Du(s * s), k = 0; uniform float i;"
           " if (s > .5) d *= 2;"
           " illuminance(P, N, PI) c += Cl * (normalize(L).normalize(N));"
           " for (i = 0; i < 3; i += 1) { if (t > .25 * i) k += noise(4 * P) + d; }"
           " c += diffuse(faceforward(normalize(N), I)); float e = d * k;" +
           last + " Ci = c * (1 + d + e); Oi = 1; }";
  };
  auto rib = [](const std::string& name) {
    return "WorldBegin " + kSeen + "Translate 0 0 4 LightSource \"lamp\" 1 TransformBegin Surface \"" + name +
           "\" Sphere 1 -1 1 360 TransformEnd WorldEnd";
  };
  const std::string lamp =
      "light lamp() { illuminate(point \"shader\" (2, 2, -3)) { Cl = 9 * noise(3 * Ps) / (L.L); } }";
  RayScene early(rib("early"), {{"early", shader("early", "")}, {"lamp", lamp}});
  RayScene late(rib("late"), {{"late", shader("late", " e += 0 * Du(e);")}, {"lamp", lamp}});
  EXPECT_EQ(early.messages() + late.messages(), "");
  std::vector<TestRay> rays;
  for (int i = 0; i < 500; ++i) {
    float a = 0.37f * static_cast<float>(i), r = 0.0018f * static_cast<float>(i);
    rays.push_back({{r * std::cos(a), r * std::sin(a), 0}});
  }
  const std::vector<slvm::RayOutput> Ci{
      RayScene::output(slvm::RayOutput::From::kSurface, "Ci", slvm::Type::kColor)};
  auto x = early.trace(rays, Ci), y = late.trace(rays, Ci);
  float most = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(x[i].values[0].size(), 3u);
    EXPECT_EQ(x[i].values[0], y[i].values[0]) << i;
    most = std::max(most, x[i].values[0][0]);
  }
  EXPECT_GT(most, 0.1f);
}

TEST(HitGrid, shaders_at_hits_differentiate) {
  RayScene s("WorldBegin " + kSeen +
                 "Surface \"slope\" Patch \"bilinear\" \"P\" [0 0 5 2 0 5 0 4 5 2 4 5] WorldEnd",
             {{"slope", "surface slope(output varying float d = 0, a = 0; output varying normal n = 0) {"
                        " d = Du(s * s); a = area(P); n = calculatenormal(P); }"}});
  EXPECT_EQ(s.messages(), "");
  TestRay ray{{0.5f, 1, 0}};
  EXPECT_NEAR(s.value(ray, "surface:d", slvm::Type::kFloat)[0], 2 * 0.25f, 1e-3f) << "s is u";
  auto n = s.value(ray, "surface:n", slvm::Type::kNormal);
  EXPECT_NEAR(std::abs(n[2]), 8, 1e-2f) << "dPdu x dPdv";
  auto N = s.value(ray, "primitive:N", slvm::Type::kNormal);
  EXPECT_GT(n[2] * N[2], 0);
}

} // namespace
} // namespace render::testing
