// Search paths.
#include "render/state/search_path.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace render {
namespace {

using Path = std::vector<std::string>;

TEST(SearchPath, separators_previous_and_default) {
  EXPECT_EQ(parse_search_path("a:b;c", {}, {}), (Path{"a", "b", "c"}));
  EXPECT_EQ(parse_search_path("a:&:@", {"old"}, {"std"}), (Path{"a", "old", "std"}));
  EXPECT_EQ(parse_search_path("C:/x:d", {}, {}), (Path{"C:/x", "d"}));
  EXPECT_EQ(parse_search_path("", {"old"}, {}), Path{});
}

TEST(SearchPath, environment_variables) {
  setenv("RENDER_TEST_DIR", "there", 1);
  EXPECT_EQ(parse_search_path("$RENDER_TEST_DIR/x:${RENDER_TEST_DIR}y:%RENDER_TEST_DIR%", {}, {}),
            (Path{"there/x", "therey", "there"}));
  EXPECT_EQ(parse_search_path("$RENDER_TEST_NOT_SET:a", {}, {}), (Path{"a"}));
}

TEST(SearchPath, a_missing_file_is_not_found) {
  EXPECT_FALSE(find_file("no such file", {".", "/"}));
  EXPECT_FALSE(read_file("no such file"));
}

} // namespace
} // namespace render
