// Scalar fields of meshes: distances on meshes worked out by hand, and slfields as users run it.
#include "render/tools/mesh_fields.h"
#include "tests/render/run_slrender.h"

#include <gmock/gmock.h>

namespace render::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A strip of n unit squares along x, vertex 2k at (k, 0), 2k + 1 at (k, 1), the last one `stretch` long.
struct Strip {
  std::vector<int> corners, vertices;
  std::vector<float> points;
  explicit Strip(int n, float stretch = 1) {
    for (int k = 0; k <= n; ++k) {
      float x = static_cast<float>(k) + (k == n ? stretch - 1 : 0);
      points.insert(points.end(), {x, 0, 0, x, 1, 0});
    }
    for (int k = 0; k < n; ++k) {
      corners.push_back(4);
      vertices.insert(vertices.end(), {2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1});
    }
  }
  MeshGraph graph() const { return *make_mesh_graph(corners, vertices, points); }
};

TEST(MeshFields, distances_count_edges_or_their_lengths) {
  Strip strip(3, 2);
  MeshGraph mesh = strip.graph();
  EXPECT_THAT(mesh_distances(mesh, std::vector{0}, Distance::kSteps), ElementsAre(0, 1, 1, 2, 2, 3, 3, 4));
  EXPECT_THAT(mesh_distances(mesh, std::vector{0, 1}, Distance::kLength),
              ElementsAre(0, 0, 1, 1, 2, 2, 4, 4));
}

TEST(MeshFields, ends_are_farther_than_all_around_them) {
  Strip strip(4);
  MeshGraph mesh = strip.graph();
  std::vector<float> middle = mesh_distances(mesh, std::vector{4, 5}, Distance::kSteps);
  EXPECT_THAT(mesh_ends(mesh, middle), ElementsAre(0, 1, 8, 9));
}

TEST(MeshFields, vertices_are_chosen_by_number_or_place) {
  Strip strip(4);
  MeshGraph mesh = strip.graph();
  auto chosen = [&](const char* text) { return *VertexChoice::parse(text)->vertices(mesh); };
  EXPECT_THAT(chosen("3,1"), ElementsAre(3, 1));
  EXPECT_THAT(chosen("low:x:0.25"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(chosen("high:x:0"), ElementsAre(8, 9));
  EXPECT_THAT(chosen("low:y:0.5"), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_EQ(VertexChoice::parse("3,10")->vertices(mesh).error(),
            "there is no vertex 10: the mesh has 0 to 9");
  EXPECT_THAT(VertexChoice::parse("low:w:0.5").error(), HasSubstr("write low:AXIS:PART, such as low:y:0.05"));
  EXPECT_THAT(VertexChoice::parse("top").error(),
              HasSubstr("write numbers (3,17), low:y:0.05, high:y:0.05 or ends"));
}

class Slfields : public anemone::test::SlrenderTest {
protected:
  /// Its output with long lines put together.
  Outcome fields(const std::string& arguments) {
    Outcome o = run_command(fmt::format("'{}' {}", SLFIELDS_PROGRAM, arguments));
    for (size_t at; (at = o.text.find("\n    ")) != std::string::npos;)
      o.text.replace(at, 5, " ");
    return o;
  }
};

constexpr const char* kStrip =
    "SubdivisionMesh \"catmull-clark\" [4 4] [0 2 3 1 2 4 5 3] [\"interpolateboundary\"] [0 0] [] [] "
    "\"P\" [0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0]";

TEST_F(Slfields, writes_both_fields_and_leaves_the_rest) {
  file("in.rib",
       std::string("Color 1 0 0 # red\n") + kStrip + " \"tipdistance\" [9 9 9 9 9 9]\nSphere 1 -1 1 360\n");
  Outcome o = fields("in.rib -");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.text, HasSubstr("Color [1 0 0]"));
  EXPECT_THAT(o.text, HasSubstr("\"vertex float basedistance\" [0 0 0.5 0.5 1 1]"));
  EXPECT_THAT(o.text, HasSubstr("\"vertex float tipdistance\" [1 1 0.5 0.5 0 0]"));
  EXPECT_THAT(o.text, HasSubstr("Sphere 1 -1 1 360"));
  EXPECT_EQ(o.text.find("9 9"), std::string::npos);
}

TEST_F(Slfields, polygons_names_and_lengths) {
  file("in.rib", "PointsPolygons [4 4] [0 2 3 1 2 4 5 3] \"P\" [0 0 0 1 0 0 0 1 0 1 1 0 0 4 0 1 4 0]");
  Outcome o = fields("--length --base 0,1 --tips 4,5 --basename b --tipname t in.rib -");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.text, HasSubstr("\"varying float b\" [0 0 0.25 0.25 1 1]"));
  EXPECT_THAT(o.text, HasSubstr("\"varying float t\" [1 1 0.75 0.75 0 0]"));
}

TEST_F(Slfields, slrender_takes_them) {
  file("in.rib", kStrip);
  ASSERT_EQ(fields("in.rib mesh.rib").status, 0);
  file("show.sl", "surface show(varying float basedistance = 7;) { Oi = 1; Ci = basedistance; }");
  file("scene.rib",
       "Display \"out.exr\" \"openexr\" \"rgb\" Format 8 8 1 PixelSamples 1 1 PixelFilter \"box\" 1 1 "
       "ScreenWindow 0.4 0.6 0.95 1.05 WorldBegin Translate 0 0 1 Surface \"show\" ReadArchive \"mesh.rib\" "
       "WorldEnd");
  Outcome o = run("scene.rib");
  ASSERT_EQ(o.status, 0) << o.text;
  std::vector<float> out = pixels("out.exr");
  ASSERT_EQ(out.size(), 8u * 8 * 3);
  EXPECT_NEAR(out[3 * (4 * 8 + 4)], 0.5, 0.03);
}

TEST_F(Slfields, what_goes_wrong_is_told) {
  Outcome o = fields("none.rib out.rib");
  EXPECT_EQ(o.status, 3);
  EXPECT_THAT(o.text, HasSubstr("slfields: error: none.rib: there is no such file"));
  file("empty.rib", "Sphere 1 -1 1 360");
  o = fields("empty.rib out.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text, HasSubstr("empty.rib: there is no mesh in it: SubdivisionMesh or PointsPolygons"));
  file("in.rib", std::string("\n") + kStrip);
  o = fields("in.rib out.rib --base 77");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text, HasSubstr("in.rib:2:1: error: base: there is no vertex 77: the mesh has 0 to 5"));
  o = fields("in.rib out.rib --tips 77");
  EXPECT_THAT(o.text, HasSubstr("in.rib:2:1: error: tips: there is no vertex 77"));
  o = fields("in.rib out.rib --base ends");
  EXPECT_EQ(o.status, 2);
  EXPECT_THAT(o.text, HasSubstr("--base: ends are found by their distance from the base"));
  EXPECT_EQ(fields("in.rib out.rib --base middle").status, 2);
  file("bad.rib",
       "Spere 1 -1 1 360\nPointsPolygons [4] [0 1 2 9] \"P\" [0 0 0 1 0 0 1 1 0]\nPointsPolygons [4] [0 1 2]"
       " \"P\" [0 0 0 1 0 0 1 1 0]\nPointsPolygons [3] [0 1 2] \"Q\" [0 0 0 1 0 0 1 1 0]\n");
  o = fields("bad.rib out.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text, HasSubstr("bad.rib:1:1: error: unknown request 'Spere'; did you mean 'Sphere'?"));
  EXPECT_THAT(o.text, HasSubstr("bad.rib:2:1: error: a face has vertex 9, but P has 3"));
  EXPECT_THAT(o.text,
              HasSubstr("bad.rib:3:1: error: its faces have more corners than it has vertex numbers"));
  EXPECT_THAT(o.text, HasSubstr("bad.rib:4:1: error: this mesh has no points \"P\""));
  EXPECT_FALSE(exists("out.rib"));
  file("two.rib", "PointsPolygons [3 3] [0 1 2 3 4 5] \"P\" [0 0 0 1 0 0 1 1 0 0 5 0 1 5 0 1 6 0]");
  o = fields("two.rib out.rib");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(
      o.text,
      HasSubstr("two.rib:1:1: warning: 3 of 6 vertices hang together with none of the base: they get 1"));
}

} // namespace
} // namespace render::tools
