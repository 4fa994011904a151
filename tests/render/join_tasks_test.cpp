// Small surfaces in one grid: which may be, and that each has there what it has alone.
#include "render/prims/join_tasks.h"

#include "render/prims/dice.h"
#include "slvm/support/string_pool.h"
#include "tests/render/surface_probe.h"

#include <gtest/gtest.h>

namespace render::testing {
namespace {

/// A row of `count` squares, each `size` wide, as one mesh. `vars` may hold "{}" for values of each face.
std::string squares(int count, float size, const std::string& vars = "", float per_face = 1) {
  std::string loops, vertices, P;
  for (int i = 0; i < count; ++i) {
    loops += " 4";
    for (int k : {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1})
      vertices += " " + std::to_string(k);
  }
  for (int i = 0; i <= count; ++i)
    for (int j = 0; j < 2; ++j)
      P += " " + std::to_string(size * static_cast<float>(i)) + " " +
           std::to_string(size * static_cast<float>(j)) + " " +
           std::to_string(0.0001f * static_cast<float>(i * i));
  std::string out = "PointsPolygons [" + loops + "] [" + vertices + "] \"P\" [" + P + "]";
  if (vars.empty()) return out;
  out += " " + vars + " [";
  for (int i = 0; i < static_cast<int>(static_cast<float>(count) * per_face); ++i)
    out += " " + std::to_string(0.1f * static_cast<float>(i));
  return out + "]";
}

Options view() {
  Options out;
  out.projection = ProjectionKind::kPerspective;
  out.xres = out.yres = 100;
  return out;
}

struct Joined {
  Scene scene;
  Camera camera;
  std::vector<GridTask> apart, together;

  explicit Joined(const std::string& rib) : scene(scene_of("Translate 0 0 5 " + rib)), camera(view()) {
    SplitSettings settings;
    settings.camera = &camera;
    settings.raster_max = {100, 100};
    for (size_t i = 0; i < scene.primitives.size(); ++i)
      split_primitive(scene.primitives[i], static_cast<uint32_t>(i), settings, apart);
    together = apart;
    join_tasks(scene.primitives, together);
  }
};

TEST(JoinTasks, faces_of_a_mesh_share_a_grid) {
  Joined j(squares(10, 0.05f));
  ASSERT_EQ(j.apart.size(), 10u);
  ASSERT_EQ(j.together.size(), 1u);
  EXPECT_EQ(j.together[0].pieces, 0x3ffu);
  EXPECT_EQ(j.together[0].count(), 10);
  for (const GridTask& t : j.apart) {
    EXPECT_LE(j.together[0].raster_min.x, t.raster_min.x);
    EXPECT_GE(j.together[0].raster_max.x, t.raster_max.x);
    EXPECT_LE(j.together[0].zmin, t.zmin);
  }
}

TEST(JoinTasks, those_between_that_are_not_seen_are_left_out) {
  Joined j(squares(100, 0.005f));
  ASSERT_EQ(j.apart.size(), 100u);
  std::vector<GridTask> some;
  for (size_t k : {3, 4, 9, 66, 67, 90})
    some.push_back(j.apart[k]);
  join_tasks(j.scene.primitives, some);
  ASSERT_EQ(some.size(), 2u);
  EXPECT_EQ(some[0].primitive, 3u);
  EXPECT_EQ(some[0].pieces, (uint64_t{1} << 63) | 0b1000011u);
  EXPECT_EQ(some[1].primitive, 67u);
  EXPECT_EQ(some[1].pieces, (uint64_t{1} << 23) | 1u);
}

TEST(JoinTasks, what_differs_stays_apart) {
  EXPECT_EQ(Joined(squares(10, 0.05f, "\"uniform float heat\"")).together.size(), 10u);
  EXPECT_EQ(Joined("Polygon \"P\" [0 0 0 .05 0 0 .05 .05 0 0 .05 0] Color [1 0 0] "
                   "Polygon \"P\" [0 0 0 .05 0 0 .05 .05 0 0 .05 0]")
                .together.size(),
            2u);
  // Large ones gain nothing, and a grid as wide as the picture would be shaded where it is hidden.
  EXPECT_EQ(Joined(squares(3, 0.6f)).together.size(), 3u);
  EXPECT_EQ(Joined(squares(60, 0.06f)).together.size(), 2u);
  // Values of colours are each face's own without more ado.
  EXPECT_EQ(Joined(squares(10, 0.05f, "\"uniform color Cs\"", 3)).together.size(), 1u);
  EXPECT_EQ(Joined(squares(10, 0.05f, "\"varying float heat\"", 2.2f)).together.size(), 1u);
}

TEST(JoinTasks, pieces_are_what_they_are_alone) {
  Joined j(squares(10, 0.05f, "\"varying float heat\"", 2.2f));
  ASSERT_EQ(j.together.size(), 1u);
  slvm::StringPool strings;
  DiceContext context{&j.camera, &strings, 0, 0};
  slvm::Grid whole(2, 2), alone(2, 2);
  std::vector<Primitive> pieces;
  for (const Primitive& p : j.scene.primitives)
    pieces.push_back(p);
  dice(pieces, j.together[0], 1, context, {}, whole);
  renew_geometry(j.camera, whole);
  EXPECT_EQ(whole.lattice, slvm::Lattice::kPieces);
  GridTask task = j.apart[0];
  task.nu = j.together[0].nu;
  task.nv = j.together[0].nv;
  auto points = static_cast<size_t>(task.nu * task.nv);
  ASSERT_EQ(whole.points(), 10 * points);
  using slvm::Global;
  for (size_t piece = 0; piece < 10; ++piece) {
    dice({&pieces[piece], 1}, task, 1, context, {}, alone);
    renew_geometry(j.camera, alone);
    for (Global g : {Global::kP, Global::kN, Global::kNg, Global::kdPdu, Global::kdPdv, Global::ku,
                     Global::kv, Global::ks, Global::kt, Global::kdu, Global::kdv})
      for (size_t k = 0; k < points; ++k)
        for (size_t c = 0; c < static_cast<size_t>(slvm::components(slvm::global_info(g).type)); ++c)
          EXPECT_EQ(whole.variable(g).get(c, piece * points + k), alone.variable(g).get(c, k));
    for (size_t k = 0; k < points; ++k)
      EXPECT_EQ(whole.primvar("heat")->get(0, piece * points + k), alone.primvar("heat")->get(0, k));
  }
}

} // namespace
} // namespace render::testing
