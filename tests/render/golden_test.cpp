// Pictures compared with the ones in tests/render/golden.
#include "tests/render/golden_picture.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

namespace fs = std::filesystem;

class Golden : public ::testing::TestWithParam<std::string> {
protected:
  /// Renders `name`.rib after `before`, and compares out.exr with `picture`.exr.
  void check(const std::string& name, const std::string& picture, const std::string& before = "") {
    directory_.write("before.rib", before + "\n");
    std::string command =
        fmt::format("cd '{}' && '{}' --shaders '{}/shaders:@' --archives '{}' before.rib '{}/{}.rib'",
                    directory_.string(), SLRENDER_PROGRAM, GOLDEN_FOLDER, GOLDEN_FOLDER, GOLDEN_FOLDER, name);
    ASSERT_EQ(std::system(command.c_str()), 0);
    anemone::test::expect_golden((directory_ / "out.exr").string(),
                                 fmt::format("{}/{}.exr", GOLDEN_FOLDER, picture));
  }

  anemone::test::TempFolder directory_;
};

TEST_P(Golden, picture) {
  check(GetParam(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Render, Golden,
                         ::testing::Values("motion_blur", "depth_of_field", "transparency_matte", "variables",
                                           "shadow_map", "environment", "subpixel", "depth_mask", "solids"),
                         [](const auto& test) { return test.param; });

class GoldenFilter : public Golden {};

TEST_P(GoldenFilter, picture) {
  std::string name = GetParam();
  std::string width = name == "box"                                                ? "1 1"
                      : name == "sinc" || name == "bessel"                         ? "6 6"
                      : name == "triangle" || name == "gaussian" || name == "disk" ? "2 2"
                                                                                   : "4 4";
  check("filter", "filter_" + name, fmt::format("PixelFilter \"{}\" {}", name, width));
}

INSTANTIATE_TEST_SUITE_P(Render, GoldenFilter,
                         ::testing::Values("box", "triangle", "gaussian", "catmull-rom",
                                           "separable-catmull-rom", "b-spline", "sinc", "mitchell", "disk",
                                           "blackman-harris", "lanczos", "bessel"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

} // namespace
