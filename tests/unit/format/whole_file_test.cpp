// Files that appear when they are complete.
#include "slvm/support/whole_file.h"
#include "tests/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace slvm {
namespace {

namespace fs = std::filesystem;

size_t entries(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(WholeFile, appears_on_commit_and_replaces_what_was_there) {
  anemone::test::TempFolder folder;
  folder.write("a", "old");
  std::string name = (folder / "a").string();
  {
    WholeFile file(name);
    std::ofstream(file.temporary()) << "new";
    EXPECT_EQ(folder.read("a"), "old");
    EXPECT_EQ(file.commit(), "");
  }
  EXPECT_EQ(folder.read("a"), "new");
  {
    WholeFile file(name);
    std::ofstream(file.temporary()) << "dropped";
  }
  EXPECT_EQ(folder.read("a"), "new");
  EXPECT_EQ(entries(folder), 1u);
  EXPECT_EQ(write_whole_file(name, "xyz", 3), "");
  EXPECT_EQ(folder.read("a"), "xyz");
  EXPECT_NE(write_whole_file((folder / "no/such/a").string(), "xyz", 3), "");
}

/// Another process begins a file and dies, or lives on; of one that died the end may go unnoticed.
std::string begun_by_another(const std::string& name, bool dies, pid_t& process, bool noticed = true) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  process = ::fork();
  if (process == 0) {
    auto* file = new WholeFile(name); // never destroyed
    std::ofstream(file->temporary()) << "half";
    std::string path = file->temporary();
    if (::write(ends[1], path.data(), path.size()) < 0) ::_exit(1);
    ::close(ends[1]);
    if (!dies) ::sleep(20);
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string path;
  char c;
  while (::read(ends[0], &c, 1) == 1)
    path += c;
  ::close(ends[0]);
  if (dies && noticed) ::waitpid(process, nullptr, 0);
  return path;
}

TEST(WholeFile, what_the_dead_left_is_removed_and_the_living_are_left_alone) {
  anemone::test::TempFolder folder;
  std::string name = (folder / "a").string();
  pid_t dead, alive;
  std::string working = begun_by_another(name, false, alive), left = begun_by_another(name, true, dead);
  std::string other = begun_by_another(name + "b", true, dead);
  EXPECT_TRUE(fs::exists(left));
  EXPECT_EQ(write_whole_file(name, "x", 1), "");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(working));
  EXPECT_TRUE(fs::exists(other));
  pid_t unnoticed;
  left = begun_by_another(name, true, unnoticed, false);
  siginfo_t info;
  EXPECT_EQ(::waitid(P_PID, static_cast<id_t>(unnoticed), &info, WEXITED | WNOWAIT), 0);
  EXPECT_TRUE(fs::exists(left));
  EXPECT_EQ(write_whole_file(name, "x", 1), "");
  EXPECT_FALSE(fs::exists(left));
  ::kill(alive, SIGKILL);
  ::waitpid(alive, nullptr, 0);
  ::waitpid(unnoticed, nullptr, 0);
}

} // namespace
} // namespace slvm
