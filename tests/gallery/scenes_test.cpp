// The scenes of docs/gallery, at a fraction of their size, by the pass runner: every pass runs, and the
// pictures are the ones that were looked at.
#include "tests/render/golden_picture.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <sys/wait.h>

namespace {

/// A scene, how small it is made, and its picture that is compared, or two.
struct Small {
  const char* scene;
  double scale;
  const char* picture;
  const char* other = nullptr;
};

std::ostream& operator<<(std::ostream& out, const Small& s) {
  return out << s.scene;
}

class Gallery : public ::testing::TestWithParam<Small> {};

TEST_P(Gallery, scene) {
  const Small& small = GetParam();
  anemone::test::TempFolder folder;
  std::string command = fmt::format("'{}' --scale {} -o '{}' '{}/{}' 2>&1", SLPASS_PROGRAM, small.scale,
                                    folder.string(), SCENE_FOLDER, small.scene);
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string said;
  char buffer[4096];
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    said.append(buffer, n);
  int status = ::pclose(pipe);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << said;
  EXPECT_EQ(said.find("warning"), std::string::npos) << said;
  // Few rays, and few pixels: chance shows more than in the pictures of the pages.
  auto expect = [&](const char* picture, const std::string& golden) {
    anemone::test::expect_golden(fmt::format("{}/{}/{}", folder.string(), small.scene, picture),
                                 fmt::format("{}/{}", GOLDEN_FOLDER, golden), {0.01, 0.25});
  };
  expect(small.picture, fmt::format("{}.exr", small.scene));
  if (small.other) expect(small.other, fmt::format("{}_{}", small.scene, small.other));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Gallery,
    ::testing::Values(Small{"bag", 0.2, "passes.exr"}, Small{"baking", 0.2, "light_reused.exr"},
                      Small{"bleeding", 0.2, "indirectdiffuse256.exr"}, Small{"bust", 0.15, "sunny.exr"},
                      Small{"cards", 0.25, "traverse.exr"}, Small{"coral", 0.15, "coral.exr"},
                      Small{"cornell", 0.2, "bounce.exr"},
                      Small{"environment", 0.2, "occlusion_each.exr", "occlusion_direction.exr"},
                      Small{"frosted", 0.15, "passes.exr"}, Small{"guidedshadows", 0.2, "guided.exr"},
                      Small{"gumdrop", 0.25, "f0.6_0.14.exr"}, Small{"guts", 0.2, "fish.exr"},
                      Small{"jar", 0.2, "passes.exr"}, Small{"labels", 0.25, "labels.exr"},
                      Small{"occlusion", 0.2, "adaptive.exr"}, Small{"occlusionrange", 0.3, "0.7854_0.5.exr"},
                      Small{"reflectionocclusion", 0.25, "first4.exr"}, Small{"skin", 0.2, "twopass.exr"},
                      Small{"skinbuffers", 0.2, "skin_key.exr"}, Small{"skinmap", 0.2, "mixed_behind.exr"},
                      Small{"skinpoints", 0.2, "skin_front.exr"}, Small{"skintwopass", 0.2, "skin_back.exr"},
                      Small{"softshadows", 0.2, "radius0.7.exr"}, Small{"stainedglass", 0.15, "two.exr"},
                      Small{"tank", 0.2, "passes.exr"}, Small{"translucency", 0.2, "passes.exr"}),
    [](const auto& test) { return std::string(test.param.scene); });

} // namespace
