// Procedurals: called when their bound is seen, with the state of their request, and under which rules.
#include "render/state/interpreter.h"
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace render::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Procedurals : public ::testing::Test {
protected:
  void SetUp() override {
    sources_ = std::make_unique<slvm::SourceManager>();
    diagnostics_ = std::make_unique<slvm::Diagnostics>();
    interpreter_ =
        std::make_unique<Interpreter>(*sources_, *diagnostics_, [this](Scene& s) { scene_ = std::move(s); });
    interpreter_->options().search_paths["archive"] = {folder_.string()};
    interpreter_->options().search_paths["procedural"] = {folder_.string()};
    interpreter_->program_limits.seconds = 20;
  }

  void file(const std::string& name, const std::string& text) { folder_.write(name, text); }
  void program(const std::string& name, const std::string& text) {
    file(name, "#!/bin/sh\n" + text);
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  /// The number of primitives a world makes.
  size_t world(const std::string& rib) {
    interpreter_->read_text("t.rib",
                            "Format 100 100 1 PixelFilter \"box\" 1 1 WorldBegin " + rib + " WorldEnd");
    return scene_.primitives.size();
  }
  std::string messages() { return format_diagnostics(*diagnostics_, *sources_); }

  anemone::test::TempFolder folder_;
  Scene scene_;
  std::unique_ptr<slvm::SourceManager> sources_;
  std::unique_ptr<slvm::Diagnostics> diagnostics_;
  std::unique_ptr<Interpreter> interpreter_;
};

TEST_F(Procedurals, archives_are_read_with_the_state_of_the_request) {
  file("a.rib", "Color 0 1 0 Disk 0 1 360");
  EXPECT_EQ(world("AttributeBegin Translate 0 0 5 Sides 1 Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1 "
                  "1 -1 1 -1 1] "
                  "AttributeEnd Translate 9 9 9 Sides 2"),
            1u);
  EXPECT_EQ(messages(), "");
  EXPECT_EQ(scene_.primitives[0].attributes().sides, 1);
  EXPECT_EQ(scene_.primitives[0].attributes().color, Color(0, 1, 0));
  EXPECT_EQ(transform_point(scene_.primitives[0].state->object_to_camera, Vec3{0, 0, 0}), Vec3(0, 0, 5));
}

TEST_F(Procedurals, what_cannot_be_seen_is_not_opened) {
  EXPECT_EQ(world("Procedural \"DelayedReadArchive\" [\"none.rib\"] [5 6 0 1 1 2] "
                  "Procedural \"DelayedReadArchive\" [\"none.rib\"] [0 1 0 1 -5 -4]"),
            0u);
  EXPECT_EQ(messages(), "");
  // A displacement may bring it into the picture.
  world("Attribute \"displacementbound\" \"float sphere\" 5 Procedural \"DelayedReadArchive\" [\"none.rib\"] "
        "[5 6 0 1 1 2]");
  EXPECT_THAT(messages(), HasSubstr("t.rib:1:98: error: Procedural: no archive \"none.rib\""));
}

TEST_F(Procedurals, bounds_may_be_infinite) {
  file("a.rib", "Disk 0 1 360");
  EXPECT_EQ(
      world(
          "Rotate 30 1 1 1 Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1e38 1e38 -1e38 1e38 -1e38 1e38]"),
      1u);
}

TEST_F(Procedurals, one_may_make_others_but_not_for_ever) {
  file("a.rib", "Disk 0 1 360 Procedural \"DelayedReadArchive\" [\"b.rib\"] [-1 1 -1 1 0 1]");
  file("b.rib", "Disk 0 1 360");
  EXPECT_EQ(world("Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1 1 -1 1 0 1]"), 2u);
  file("c.rib", "Procedural \"DelayedReadArchive\" [\"c.rib\"] [-1 1 -1 1 0 1]");
  world("Procedural \"DelayedReadArchive\" [\"c.rib\"] [-1 1 -1 1 0 1]");
  EXPECT_THAT(messages(), HasSubstr("procedurals come out of each other more than 64 deep"));
}

TEST_F(Procedurals, blocks_stay_inside) {
  file("a.rib", "AttributeEnd WorldEnd AttributeBegin Disk 0 1 360");
  EXPECT_EQ(
      world("AttributeBegin Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1 1 -1 1 0 1] AttributeEnd"), 1u);
  EXPECT_THAT(messages(), HasSubstr("AttributeEnd: there is no open AttributeBegin"));
  EXPECT_THAT(messages(), HasSubstr("WorldEnd: a procedural cannot end the world; the request is skipped"));
  EXPECT_THAT(messages(),
              HasSubstr("Procedural: DelayedReadArchive \"a.rib\": a block is left open at its end"));
}

TEST_F(Procedurals, requests_with_mistakes) {
  world("Procedural \"Magic\" [\"x\"] [0 1 0 1 0 1]\nProcedural \"RunProgram\" [\"x\"] [0 1 0 1 0 1]\n"
        "Procedural \"DelayedReadArchive\" [\"x\" \"y\"] [0 1 0 1 0 1]\n"
        "Procedural \"DelayedReadArchive\" [\"x\"] [1 0 0 1 0 1]\n"
        "Procedural \"DynamicLoad\" [\"x.so\"] [0 1 0 1 0 1]");
  std::string m = messages();
  EXPECT_THAT(m, HasSubstr("unknown type \"Magic\"; known are DelayedReadArchive, RunProgram, DynamicLoad"));
  EXPECT_THAT(m, HasSubstr("\"RunProgram\" takes a program and the data for it, found 1"));
  EXPECT_THAT(m, HasSubstr("\"DelayedReadArchive\" takes the name of a file, found 2"));
  EXPECT_THAT(m, HasSubstr("the bound is empty; expected xmin xmax ymin ymax zmin zmax"));
  EXPECT_THAT(m, HasSubstr("\"DynamicLoad\" takes a plug-in and its parameters, found 1"));
}

const char* kAsk = "Procedural \"RunProgram\" [\"maker\" \"the data\"] [-1 1 -1 1 0 1] ";

TEST_F(Procedurals, programs_are_run_only_where_the_user_allows_it) {
  program("maker", "touch ran");
  EXPECT_EQ(world(kAsk), 0u);
  EXPECT_THAT(messages(),
              HasSubstr("error: Procedural: RunProgram \"maker\": scenes may run programs only with "
                        "--allow-programs"));
  EXPECT_FALSE(fs::exists("ran"));
}

TEST_F(Procedurals, a_program_lives_through_all_questions) {
  program("maker", "n=0\nwhile read line; do n=$((n+1)); echo \"Attribute \\\"identifier\\\" \\\"name\\\" "
                   "\\\"$n $line\\\" "
                   "Disk 0 1 360\"; printf '\\377'; done");
  interpreter_->allow_programs = true;
  EXPECT_EQ(world(std::string(kAsk) + kAsk), 2u);
  EXPECT_EQ(messages(), "");
  ASSERT_EQ(scene_.primitives.size(), 2u);
  // Half the image is 100 pixels wide: the bound covers all of it.
  EXPECT_EQ(scene_.primitives[0].attributes().name, "1 10000 the data");
  EXPECT_EQ(scene_.primitives[1].attributes().name, "2 10000 the data");
}

TEST_F(Procedurals, the_command_may_have_arguments) {
  program("maker", "while read line; do echo \"Disk 0 $1 360\"; printf '\\377'; done");
  interpreter_->allow_programs = true;
  EXPECT_EQ(world("Procedural \"RunProgram\" [\"maker 3\" \"\"] [-1 1 -1 1 0 1]"), 1u);
  EXPECT_EQ(messages(), "");
}

TEST_F(Procedurals, programs_that_fail_are_reported_once) {
  interpreter_->allow_programs = true;
  interpreter_->program_limits.seconds = 0.3;
  world(kAsk);
  EXPECT_THAT(messages(), HasSubstr("RunProgram \"maker\": no such program in the search path \""));
  const std::pair<const char*, const char*> kCases[] = {
      {"exit 3", "it ended with exit status 3, without an answer"},
      {"echo Disk 0 1 360", "it ended with exit status 0, its answer lacks the end mark (byte 0377)"},
      {"kill -9 $$", "it was ended by signal 9, without an answer"},
      {"sleep 5", "it was silent for 0.3 seconds"}};
  for (auto [text, message] : kCases) {
    SetUp();
    interpreter_->allow_programs = true;
    interpreter_->program_limits.seconds = 0.3;
    program("maker", text);
    EXPECT_EQ(world(std::string(kAsk) + kAsk), 0u);
    EXPECT_THAT(messages(), HasSubstr(message));
    EXPECT_EQ(diagnostics_->error_count(), 1u) << messages();
  }
}

TEST_F(Procedurals, mistakes_in_an_answer_have_a_line) {
  program("maker", "read line; echo 'Disk 0 1 360'; echo 'Disk x'; printf '\\377'");
  interpreter_->allow_programs = true;
  EXPECT_EQ(world(kAsk), 1u);
  EXPECT_THAT(messages(), HasSubstr("<maker>:2:6: error: Disk: expected a number for 'height', found 'x'"));
}

} // namespace
} // namespace render::testing
