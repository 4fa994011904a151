// No light between pieces: surfaces of many patches that fill the whole image leave every sample covered.
#include "tests/render/render_text.h"

#include <gtest/gtest.h>

#include <random>

namespace render::testing {
namespace {

/// n x n points over [-1,2] x [-1,2] with random heights.
std::string bumps(int n, float height) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> z(-height, height);
  std::string P = " \"P\" [";
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      P += std::to_string(3.0f * static_cast<float>(i) / static_cast<float>(n - 1) - 1) + " " +
           std::to_string(3.0f * static_cast<float>(j) / static_cast<float>(n - 1) - 1) + " " +
           std::to_string(z(random)) + " ";
  return P + "] ";
}

/// Pixels that are not wholly covered.
int open_pixels(const std::string& surface) {
  Rendered r = render_text(
      "Format 120 120 1 PixelSamples 3 3 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 30 "
      "WorldBegin Translate -.5 -.5 3 " +
      surface + " WorldEnd");
  EXPECT_EQ(r.messages, "");
  int open = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x)
      open += r.alpha(x, y) < 0.9999f;
  return open;
}

TEST(Seams, patch_meshes) {
  EXPECT_EQ(
      open_pixels(
          "Basis \"b-spline\" 1 \"b-spline\" 1 PatchMesh \"bicubic\" 9 \"nonperiodic\" 9 \"nonperiodic\"" +
          bumps(9, 0.4f)),
      0);
  EXPECT_EQ(open_pixels("PatchMesh \"bicubic\" 13 \"nonperiodic\" 13 \"nonperiodic\"" + bumps(13, 0.2f)), 0);
}

const char kKnots[] = " 9 4 [0 0 0 0 1 2 3 4 5 6 6 6 6] 0 6 ";

TEST(Seams, nurbs) {
  EXPECT_EQ(open_pixels(std::string("NuPatch") + kKnots + kKnots + bumps(9, 0.4f)), 0);
}

TEST(Seams, trimmed_nurbs) {
  EXPECT_EQ(
      open_pixels("TrimCurve [1] [3] [0 0 0 1 1 2 2 3 3 4 4 4] [0] [4] [9] [5.7 17.1 3 .9 .3 .9 3 17.1 5.7] "
                  "[3 17.1 5.7 17.1 3 .9 .3 .9 3] [1 3 1 3 1 3 1 3 1] NuPatch" +
                  std::string(kKnots) + kKnots + bumps(9, 0.4f)),
      0);
}

TEST(Seams, subdivision_meshes_of_mixed_faces) {
  constexpr int kSide = 9;
  std::string counts, vertices;
  for (int j = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      int k = j * kSide + i;
      auto face = [&](std::initializer_list<int> corners) {
        counts += std::to_string(corners.size()) + " ";
        for (int c : corners)
          vertices += std::to_string(c) + " ";
      };
      if ((i * 7 + j * 3) % 5 == 0) {
        face({k, k + 1, k + kSide + 1});
        face({k, k + kSide + 1, k + kSide});
      } else {
        face({k, k + 1, k + kSide + 1, k + kSide});
      }
    }
  EXPECT_EQ(open_pixels("SubdivisionMesh \"catmull-clark\" [" + counts + "] [" + vertices +
                        "] [\"interpolateboundary\"] [0 0] [] []" + bumps(kSide, 0.4f)),
            0);
}

TEST(Seams, concave_polygons) {
  EXPECT_EQ(open_pixels("PointsPolygons [6 6] [0 1 2 3 4 5 3 2 6 7 5 4] \"P\" [-3 -3 0 3 -3 0 3 .7 0 .4 .3 0 "
                        ".5 .9 0 -3 .6 0 "
                        "3 3 0 -3 3 0]"),
            0);
}

// The seam of a torus turns back at the silhouette: its outline must reach as far as its neighbours'.
TEST(Seams, a_side_that_turns_back_at_the_silhouette_leaves_no_notch) {
  Rendered r = render_text(
      "Format 160 120 1 PixelSamples 8 8 Projection \"perspective\" \"fov\" 30 WorldBegin Translate 0 0 5 "
      "Rotate 60 1 0 0 Torus 0.8 0.35 0 360 360 WorldEnd");
  auto column = [&](int x) {
    double sum = 0;
    for (int y = 0; y < 60; ++y)
      sum += r.alpha(x, y);
    return sum;
  };
  for (int x = 74; x < 86; ++x)
    EXPECT_NEAR(column(x), (column(x - 4) + column(x + 4)) / 2, 0.2) << x;
}

} // namespace
} // namespace render::testing
