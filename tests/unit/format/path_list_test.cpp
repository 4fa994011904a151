// Lists of folders, and what is found in them.
#include "slvm/support/path_list.h"

#include "tests/temp_folder.h"

#include <gmock/gmock.h>

namespace slvm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(PathList, ColonsAndSemicolonsSeparateFoldersButNotDrives) {
  EXPECT_THAT(split_path_list("a:b/c;d"), ElementsAre("a", "b/c", "d"));
  EXPECT_THAT(split_path_list(":a::;b:"), ElementsAre("a", "b"));
  EXPECT_THAT(split_path_list("c:/models:d:\\maps;e"), ElementsAre("c:/models", "d:\\maps", "e"));
  EXPECT_THAT(split_path_list("a:/b"), ElementsAre("a:/b"));
  EXPECT_THAT(split_path_list("ab:/b"), ElementsAre("ab", "/b"));
  EXPECT_THAT(split_path_list(""), IsEmpty());
}

TEST(PathList, TheFirstFolderThatHasTheFileCounts) {
  anemone::test::TempFolder folder;
  folder.write("one/x.sl", "");
  folder.write("two/x.sl", "");
  folder.write("two/x.slo", "");
  folder.write("two/y", "");
  const std::string one = (folder / "one").string(), two = (folder / "two").string();
  const std::vector<std::string> both{one, two};
  EXPECT_EQ(find_in_folders("x.slo", both), two + "/x.slo");
  EXPECT_EQ(find_in_folders("../two/y", both), two + "/y");
  EXPECT_EQ(find_in_folders("two", std::vector<std::string>{folder.string()}), "") << "a folder is no file";
  EXPECT_EQ(find_in_folders(two + "/y", {}), two + "/y");
  EXPECT_EQ(find_in_folders(two + "/none", both), "");
  EXPECT_EQ(find_shader_file("x", both), one + "/x.sl");
  EXPECT_EQ(find_shader_file("x.slo", both), two + "/x.slo");
  EXPECT_EQ(find_shader_file("y", both), two + "/y");
  EXPECT_EQ(find_shader_file(two + "/x", both), two + "/x.slo");
  EXPECT_EQ(find_shader_file("z", both), "");
}

} // namespace
} // namespace slvm
