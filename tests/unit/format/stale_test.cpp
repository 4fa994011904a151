// Whether sources are found again, and found to have changed.
#include "slvm/format/stale.h"

#include "slvm/format/slo.h"
#include "tests/temp_folder.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace slvm {
namespace {

namespace fs = std::filesystem;

class Stale : public testing::Test {
protected:
  std::string write(const std::string& name, const std::string& text) {
    folder_.write(name, text);
    return (folder_ / name).string();
  }
  static uint64_t hash(const std::string& text) { return hash_bytes(std::as_bytes(std::span(text))); }
  // A shader compiled from `main`, which includes `header`; both were "old" then.
  static Program program(const std::string& main, const std::string& header) {
    Program p;
    p.source_name = main;
    p.sources = {{main, hash("old")}, {header, hash("old")}};
    return p;
  }
  std::string slo(const std::string& name) { return (folder_ / name).string(); }

  anemone::test::TempFolder folder_;
};

TEST_F(Stale, SourcesLieBesideTheShader) {
  write("x.sl", "old");
  write("x.h", "old");
  EXPECT_EQ(stale_warning(program("x.sl", "x.h"), slo("x.slo")), "");
  EXPECT_EQ(stale_warning(program("shaders/x.sl", "shaders/x.h"), slo("x.slo")), ""); // compiled from above
  std::string changed = write("x.sl", "new");
  EXPECT_EQ(stale_warning(program("shaders/x.sl", "shaders/x.h"), slo("x.slo")),
            slo("x.slo") + " is older than its source: " + changed +
                " has changed; compile it again with slc");
  EXPECT_EQ(stale_warning(program("x.sl", "x.h"), slo("x.slo"), true),
            slo("x.slo") + " is older than its source: " + changed + " has changed; the source is taken");
}

TEST_F(Stale, IncludedFilesAreFoundFromTheMainOne) {
  write("shaders/x.sl", "old");
  std::string header = write("include/x.h", "new");
  for (const std::string& main : {std::string("shaders/x.sl"), slo("shaders/x.sl")}) {
    std::string included = (fs::path(main).parent_path() / "../include/x.h").string();
    std::vector<SourceCheck> checks = check_sources(program(main, included), slo("shaders/x.slo"));
    ASSERT_EQ(checks.size(), 2u);
    EXPECT_EQ(checks[0].state, SourceState::kSame);
    EXPECT_EQ(checks[1].state, SourceState::kChanged);
    EXPECT_EQ(checks[1].path, header);
  }
}

TEST_F(Stale, WhatIsNotThereSaysNothing) {
  Program p = program("x.sl", "x.h");
  EXPECT_EQ(stale_warning(p, slo("x.slo")), "");
  write("x.h", "new"); // without the main file it could be anybody's
  EXPECT_EQ(stale_warning(p, slo("x.slo")), "");
  EXPECT_EQ(check_sources(p, slo("x.slo"))[0].state, SourceState::kMissing);
  write("x.sl", "old");
  fs::remove(folder_ / "x.h");
  EXPECT_EQ(stale_warning(p, slo("x.slo")), "");
  p.sources.clear(); // made by an older compiler
  write("x.sl", "new");
  EXPECT_EQ(stale_warning(p, slo("x.slo")), "");
}

TEST_F(Stale, AbsoluteNamesAreFoundFromAnywhere) {
  std::string source = write("elsewhere/x.sl", "new");
  EXPECT_EQ(check_sources(program(source, "x.h"), "out/x.slo")[0].state, SourceState::kChanged);
  EXPECT_EQ(find_source(program("<stdin>", ""), slo("x.slo"), "<stdin>"), "");
}

} // namespace
} // namespace slvm
