// surfacecells(): the two nearest points of a cloud, against all of them.
#include "tests/dso/with_plugin.h"
#include "tests/unit/subsurface/surfaces.h"

#include <algorithm>

namespace subsurface::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using SurfaceCells = WithPlugin;

TEST_F(SurfaceCells, AreThoseOfTheNearestPoints) {
  const PointCloud centres = ball(200, 1.2f);
  save("cells.ply", centres);
  const std::string call =
      "float a = 0, b = 0; point c = 0; surfacecells(" + quoted("cells.ply") + ", P, a, b, c); ";
  const auto distances = run(call + "Ci = color(a, b, distance(c, P));", 7, 5),
             places = run(call + "Ci = color(c);", 7, 5);
  EXPECT_THAT(messages(), IsEmpty());
  for (size_t g = 0; g < distances.size(); ++g) {
    const Vec3 P{static_cast<float>(g % 7) / 6, static_cast<float>(g / 7) / 4, 1};
    std::vector<std::pair<float, size_t>> all;
    for (size_t i = 0; i < centres.size(); ++i)
      all.emplace_back(length(P - centres.position[i]), i);
    std::sort(all.begin(), all.end());
    EXPECT_NEAR(distances[g].x, all[0].first, 1e-6f);
    EXPECT_NEAR(distances[g].y, all[1].first, 1e-6f);
    EXPECT_NEAR(distances[g].z, all[0].first, 1e-6f);
    EXPECT_EQ(places[g], centres.position[all[0].second]);
  }
}

TEST_F(SurfaceCells, CloudsThatHaveNone) {
  save("one.ply", ball(1, 1));
  const std::string call = "float a = 7, b = 7; point c = 7; surfacecells(";
  EXPECT_THAT(run(call + quoted("none.ply") + ", P, a, b, c); Ci = color(a, b, xcomp(c));", 2),
              Each(Color{}));
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("none.ply")));
  EXPECT_THAT(run(call + quoted("one.ply") + ", P, a, b, c); Ci = a;", 2), Each(Color{}));
  EXPECT_THAT(new_messages(), ElementsAre(HasSubstr("one.ply: cells need two points or more")));
}

} // namespace
} // namespace subsurface::test
