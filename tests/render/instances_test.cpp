// Meshes that are there many times: what instances share, how little each takes, and that pictures do not
// show it.
#include "tests/render/surface_probe.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {
namespace {

/// A bumpy sheet of n x n squares, each cut in two, from -1 to 1; `more` may hold variables.
std::string sheet(int n, const std::string& more = "", const char* request = "PointsPolygons") {
  std::string counts, corners, points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      points += fmt::format("{:.5f} {:.5f} {:.5f} ", 2.0 * i / n - 1, 2.0 * j / n - 1,
                            0.2 * std::sin(0.7 * i) * std::cos(0.9 * j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      counts += "3 3 ";
      corners += fmt::format("{} {} {} {} {} {} ", a, a + 1, b + 1, a, b + 1, b);
    }
  return fmt::format("{} [{}] [{}] \"P\" [{}] {} ", request, counts, corners, points, more);
}

/// Three places, one of them mirrored; `what(k)` at each.
template <class F> std::string places(F&& what) {
  return fmt::format("AttributeBegin Color [1 .5 0] Translate -1.4 0 0 Rotate 30 1 1 0 {} AttributeEnd "
                     "AttributeBegin Color [0 .5 1] Translate .7 .4 1 Rotate 60 0 1 1 {} AttributeEnd "
                     "AttributeBegin Sides 1 Translate .4 -.8 3 Scale -1 1 1.5 {} AttributeEnd ",
                     what(0), what(1), what(2));
}

std::string picture(const std::string& world, const std::string& before = "") {
  return "Format 60 40 1 PixelSamples 2 2 Projection \"perspective\" \"fov\" 45 Translate 0 0 5 " + before +
         " WorldBegin " + world + " WorldEnd";
}

std::string object(const std::string& content) {
  return "ObjectBegin 1 " + content + " ObjectEnd ";
}
std::string instances() {
  return places([](int) { return "ObjectInstance 1"; });
}
/// The same, but no two meshes say the same.
std::string written_out(int n, const char* request = "PointsPolygons") {
  return places([=](int k) { return sheet(n, fmt::format("\"constant float number\" [{}]", k), request); });
}

size_t meshes(const Scene& s) {
  std::set<const Pieces*> out;
  for (const PrimitiveList::Run& run : s.primitives.runs())
    out.insert(run.pieces.get());
  return out.size();
}

void expect_same(const Rendered& a, const Rendered& b) {
  EXPECT_GT(a.covered(), 200);
  for (int y = a.image.rect.y0; y < a.image.rect.y1; ++y)
    for (int x = a.image.rect.x0; x < a.image.rect.x1; ++x)
      ASSERT_EQ(a.Ci(x, y), b.Ci(x, y)) << x << ' ' << y;
}

TEST(Instances, have_one_mesh_in_common) {
  const Scene s = scene_of(object(sheet(12)) + instances());
  EXPECT_EQ(s.primitives.size(), 3u * 288);
  EXPECT_EQ(s.primitives.runs().size(), 3u);
  EXPECT_EQ(meshes(s), 1u);
  // What an instance takes besides its state, whatever the mesh.
  EXPECT_LE(sizeof(PrimitiveList::Run), 40u);
  // Each face is found where it belongs.
  size_t k = 0;
  for (const Primitive& p : s.primitives) {
    EXPECT_EQ(p.state.get(), s.primitives.runs()[k / 288].state.get());
    EXPECT_EQ(at(p, 0.5f, 0.5f).P, at(s.primitives[k % 288], 0.5f, 0.5f).P);
    ++k;
  }
  EXPECT_EQ(k, s.primitives.size());
  EXPECT_EQ(s.primitives[0].attributes().color, Color(1, 0.5f, 0));
  EXPECT_EQ(s.primitives[287].attributes().color, Color(1, 0.5f, 0));
  EXPECT_EQ(s.primitives[288].attributes().color, Color(0, 0.5f, 1));
  EXPECT_TRUE(s.primitives[863].state->mirrored);
}

TEST(Instances, are_known_by_what_they_say) {
  EXPECT_EQ(meshes(scene_of(sheet(12) + sheet(12))), 1u);
  EXPECT_EQ(meshes(scene_of("ArchiveBegin \"a\" " + sheet(12) + " ArchiveEnd " +
                            places([](int) { return "ReadArchive \"a\""; }))),
            1u);
  EXPECT_EQ(meshes(scene_of("ArchiveBegin \"a\" " + sheet(12, "", "SubdivisionMesh \"loop\"") +
                            " ArchiveEnd " + places([](int) { return "ArchiveInstance \"a\""; }))),
            1u);
  anemone::test::TempFolder folder;
  folder.write("a.rib", sheet(12));
  const std::string file = (folder / "a.rib").string();
  EXPECT_EQ(meshes(scene_of(places([&](int) { return "ReadArchive \"" + file + "\""; }))), 1u);
  // Other numbers, other types, other schemes are other meshes.
  EXPECT_EQ(meshes(scene_of(sheet(12) + sheet(13))), 2u);
  EXPECT_EQ(meshes(scene_of(sheet(12, "\"constant float x\" [1]") + sheet(12, "\"constant float x\" [2]"))),
            2u);
  EXPECT_EQ(meshes(scene_of("Declare \"x\" \"constant point\" " + sheet(12, "\"x\" [1 2 3]") +
                            "Declare \"x\" \"constant float[3]\" " + sheet(12, "\"x\" [1 2 3]"))),
            2u);
  EXPECT_EQ(meshes(scene_of(sheet(12, "", "SubdivisionMesh \"loop\"") +
                            sheet(12, "", "SubdivisionMesh \"bilinear\""))),
            2u);
}

TEST(Instances, look_like_meshes_of_their_own) {
  for (const char* request :
       {"PointsPolygons", "SubdivisionMesh \"loop\"", "SubdivisionMesh \"catmull-clark\""}) {
    SCOPED_TRACE(request);
    // Below and above the size from which blocks of a mesh wait for a bucket.
    for (int n : {12, 36}) {
      const Rendered shared = render_text(picture(object(sheet(n, "", request)) + instances()), {}, true);
      const Rendered apart = render_text(picture(written_out(n, request)), {}, true);
      EXPECT_EQ(shared.messages, "");
      EXPECT_EQ(meshes(shared.scene), 1u);
      EXPECT_EQ(meshes(apart.scene), 3u);
      expect_same(shared, apart);
      FrameSettings s;
      s.threads = 1;
      expect_same(shared, render_text(picture(object(sheet(n, "", request)) + instances()), s, true));
    }
  }
}

TEST(Instances, may_move_and_change_their_shape) {
  const std::string moving =
      "Translate -.5 0 0 MotionBegin [0 1] Translate 0 0 0 Translate .8 .2 0 MotionEnd ";
  const std::string shutter = "Shutter 0 1";
  expect_same(render_text(picture(moving + object(sheet(36)) + instances(), shutter), {}, true),
              render_text(picture(moving + written_out(36), shutter), {}, true));
  // From a mesh to another, which happens to be of the same shape.
  Rendered deforming = render_text(
      picture("MotionBegin [0 1] " + sheet(36) + sheet(36, "\"constant float x\" [1]") + " MotionEnd",
              shutter),
      {}, true);
  EXPECT_EQ(deforming.messages, "");
  const Primitive p = deforming.scene.primitives[7];
  ASSERT_EQ(p.deformation.size(), 2u);
  EXPECT_EQ(at(*p.deformation[1].value, 0.5f, 0.5f).P, at(p, 0.5f, 0.5f).P);
  // Triangles that move have other parameters than those that stand still.
  const Rendered still = render_text(picture(sheet(36), shutter), {}, true);
  EXPECT_GT(still.covered(), 200);
  double difference = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x)
      difference += glm::length(deforming.Ci(x, y) - still.Ci(x, y));
  EXPECT_LT(difference, 0.02 * still.covered());
}

TEST(Instances, that_are_hidden_are_not_split) {
  const size_t all = 2 * 36 * 36;
  const std::string wall = "AttributeBegin Translate 0 0 -1 Polygon \"P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] "
                           "AttributeEnd ";
  const Rendered open = render_text(picture(object(sheet(36)) + instances()));
  EXPECT_EQ(open.report.primitives, 3 * all);
  EXPECT_EQ(open.report.split_primitives, 3 * all);
  const Rendered hidden = render_text(picture(wall + object(sheet(36)) + instances()));
  EXPECT_EQ(hidden.report.primitives, 3 * all + 1);
  EXPECT_EQ(hidden.report.split_primitives, 1u);
  // Where culling is off, as for baking, they are.
  EXPECT_EQ(render_text(picture(wall + "Attribute \"cull\" \"hidden\" 0 " + object(sheet(36)) + instances()))
                .report.split_primitives,
            3 * all + 1);
  // Nor are those outside the picture, or of which rays alone know.
  EXPECT_EQ(render_text(picture("Translate 90 0 0 " + sheet(36))).report.split_primitives, 0u);
  EXPECT_EQ(
      render_text(picture("Attribute \"visibility\" \"int camera\" 0 " + sheet(36))).report.split_primitives,
      0u);
  // Of one mesh, blocks that nothing shows are not.
  const Rendered part = render_text(picture("Translate 0 1.9 -2 " + sheet(100)));
  EXPECT_GT(part.report.split_primitives, 0u);
  EXPECT_LT(part.report.split_primitives, part.report.primitives / 2);
}

TEST(Instances, show_nothing_between_samples_that_would_have_to_be_shaded) {
  const std::string small = object(sheet(120)) + instances(), blurred = "DepthOfField 8 1 5 ";
  const std::string all = "Attribute \"cull\" \"hidden\" 0 ";
  for (const std::string& camera : {std::string(), blurred}) {
    const Rendered some = render_text(picture(small, camera)),
                   every = render_text(picture(all + small, camera));
    expect_same(some, every);
    if (camera.empty()) {
      EXPECT_LT(some.report.shaded_points, every.report.shaded_points * 3 / 4);
    }
  }
}

TEST(Instances, of_a_mesh_in_a_solid_are_cut_at_once) {
  const std::string solids = "SolidBegin \"intersection\" SolidBegin \"primitive\" " + sheet(36) +
                             "SolidEnd SolidBegin \"primitive\" Sphere 1 -1 1 360 SolidEnd SolidEnd";
  const Rendered r = render_text(picture(solids));
  EXPECT_EQ(r.report.split_primitives, r.report.primitives);
}

TEST(PrimitiveList, runs_are_taken_and_appended) {
  const Scene s = scene_of("Sphere 1 -1 1 360 " + sheet(3) + "Disk 0 1 360");
  const size_t n = s.primitives.size();
  ASSERT_EQ(n, 20u);
  ASSERT_EQ(s.primitives.runs().size(), 3u);
  for (auto [number, run] : {std::pair{0u, 0u}, {1u, 1u}, {18u, 1u}, {19u, 2u}})
    EXPECT_EQ(s.primitives.run_number(number), run);
  PrimitiveList list = s.primitives;
  PrimitiveList tail = list.take_from(1);
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(tail.size(), 19u);
  EXPECT_EQ(at(tail[0], 1, 1).P, at(s.primitives[1], 1, 1).P);
  tail.pop_back();
  EXPECT_EQ(tail.size(), 18u);
  list.append(std::move(tail));
  EXPECT_EQ(list.size(), 19u);
  EXPECT_EQ(at(list.back(), 1, 1).P, at(s.primitives[18], 1, 1).P);
  EXPECT_EQ(list.take_from(19).size(), 0u);
}

TEST(PrimitiveList, boxes_hold_all_pieces) {
  const Scene s = scene_of("Rotate 20 1 2 3 " + sheet(36));
  const PrimitiveList::Run& run = s.primitives.runs()[0];
  ASSERT_EQ(run.pieces->blocks().size(), (run.count + Pieces::kBlock - 1) / Pieces::kBlock);
  const Box whole = run.camera_bound();
  for (uint32_t k = 0; k < run.count; ++k) {
    const Box box = run.primitive(k).camera_bound({}), block = run.camera_bound(k / Pieces::kBlock);
    for (const Box* outer : {&block, &whole})
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(box.min[c], outer->min[c]) << k;
        EXPECT_LE(box.max[c], outer->max[c]) << k;
      }
  }
}

} // namespace
} // namespace render::testing
