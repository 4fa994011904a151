// Tables of points as files: back and forth, and what is said of files that are none.
#include "render/caches/point_table.h"

#include "slvm/support/files.h"
#include "tests/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>

namespace render {
namespace {

using ::testing::HasSubstr;

PointTable sample_table() {
  PointTable t;
  t.kind = "irradiance cache";
  t.points = 3;
  t.add("P", 3) = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  t.add("occlusion", 1) = {0.25f, 0.5f, -1e-30f};
  return t;
}

std::string error_of(std::vector<std::byte> bytes) {
  auto table = parse_point_table(bytes, "x.ocf");
  return table ? "" : table.error();
}

TEST(PointTable, comes_back_as_it_was) {
  anemone::test::TempFolder folder;
  const std::string path = (folder / "a.ocf").string();
  const PointTable t = sample_table();
  ASSERT_TRUE(write_point_table(path, t));
  auto back = read_point_table(path);
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(back->kind, t.kind);
  EXPECT_EQ(back->points, 3u);
  ASSERT_EQ(back->columns.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back->columns[i].name, t.columns[i].name);
    EXPECT_EQ(back->columns[i].components, t.columns[i].components);
    EXPECT_EQ(back->columns[i].values, t.columns[i].values);
  }
  EXPECT_TRUE(back->find("P", 3));
  EXPECT_FALSE(back->find("P", 1));
  EXPECT_FALSE(back->find("N", 3));
  // Nothing of the temporary file is left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.string()), {}), 1);
}

TEST(PointTable, has_the_layout_that_is_documented) {
  PointTable t;
  t.kind = "k";
  t.points = 1;
  t.add("ab", 1) = {1.0f};
  const std::vector<std::byte> bytes = format_point_table(t);
  ASSERT_EQ(bytes.size(), 32u + 4 + 1 + 4 + 2 + 4 + 4);
  auto at = [&](size_t i) { return std::to_integer<int>(bytes[i]); };
  EXPECT_EQ(at(0), 0x89);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(&bytes[1]), 3), "SLP");
  EXPECT_EQ(at(8), 1);  // version
  EXPECT_EQ(at(12), 1); // columns
  EXPECT_EQ(at(16), 1); // points
  EXPECT_EQ(at(32), 1); // length of the kind
  EXPECT_EQ(at(36), 'k');
  EXPECT_EQ(at(37), 2);
  EXPECT_EQ(at(41), 'a');
  EXPECT_EQ(at(43), 1); // components
  float value = 0;
  std::memcpy(&value, &bytes[47], sizeof value);
  EXPECT_EQ(value, 1.0f);
}

TEST(PointTable, says_what_is_wrong_and_what_to_do) {
  const std::vector<std::byte> good = format_point_table(sample_table());
  EXPECT_EQ(error_of(good), "");
  EXPECT_EQ(error_of({}), "x.ocf: this is neither an irradiance cache nor a photon map of Anemone");
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
  const auto text = std::as_bytes(std::span(ply));
  EXPECT_EQ(error_of({text.begin(), text.end()}),
            "x.ocf: this is neither an irradiance cache nor a photon map of Anemone");
  EXPECT_EQ(error_of({good.begin(), good.begin() + 20}),
            "x.ocf: the file is cut off; make it anew with the scene that writes it");
  EXPECT_EQ(error_of({good.begin(), good.end() - 4}),
            "x.ocf: the file is cut off or damaged: its contents do not match their checksum; make it anew "
            "with the scene that writes it");
  std::vector<std::byte> bytes = good;
  bytes[50] ^= std::byte{4};
  EXPECT_THAT(error_of(bytes), HasSubstr("damaged: its contents do not match"));
  bytes = good;
  bytes[8] = std::byte{7};
  EXPECT_EQ(error_of(bytes), "x.ocf: the file has version 7 of the format, this program reads version 1; "
                             "make it anew with the scene that writes it");
}

TEST(PointTable, contradictions_with_a_fitting_checksum_are_found) {
  auto broken = [](auto&& change) {
    PointTable t = sample_table();
    change(t);
    return error_of(format_point_table(t));
  };
  const std::string said =
      "x.ocf: the file is damaged: it contradicts itself; make it anew with the scene that writes it";
  EXPECT_EQ(broken([](PointTable& t) { t.points = 4; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.points = ~size_t{0} / 2; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.kind = ""; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.kind = std::string(65, 'x'); }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.columns[1].name = "P"; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.columns[1].name = "a\n"; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.columns[1].components = 0; }), said);
  EXPECT_EQ(broken([](PointTable& t) { t.columns[1].values[1] = std::numeric_limits<float>::quiet_NaN(); }),
            said);
}

TEST(PointTable, a_file_that_is_missing_is_named) {
  EXPECT_THAT(read_point_table("/nonexistent/x.ocf").error(), HasSubstr("/nonexistent/x.ocf"));
}

} // namespace
} // namespace render
