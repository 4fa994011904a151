// Procedurals: called when their bound is seen, with the state of their request, and under which rules.
#include "render/state/interpreter.h"
#include "tests/render/render_text.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
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
    interpreter_ = std::make_unique<Interpreter>(*sources_, *diagnostics_, [this](Scene& s) {
      scene_ = std::move(s);
      make_all();
    });
    interpreter_->options().search_paths["archive"] = {folder_.string()};
    interpreter_->options().search_paths["procedural"] = {folder_.string()};
    interpreter_->program_limits.seconds = 20;
  }

  /// What a renderer does that comes to all of them.
  void make_all() {
    Camera camera(scene_.options);
    for (size_t i = 0; i < scene_.procedurals.size(); ++i) {
      auto seen = seen_bound(scene_.procedurals[i], camera, Vec2(1));
      if (!seen) continue;
      SceneContent content = interpreter_->make_content(Procedural(scene_.procedurals[i]), seen->area);
      scene_.primitives.append(std::move(content.primitives));
      scene_.procedurals.insert(scene_.procedurals.end(), content.procedurals.begin(),
                                content.procedurals.end());
    }
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
  EXPECT_THAT(messages(),
              HasSubstr("procedurals come out of each other more than 64 deep, and goes no further; one "
                        "that contains itself needs an end: DetailRange, or IfBegin with a count that it "
                        "keeps in Attribute \"user\""));
}

TEST_F(Procedurals, one_that_doubles_itself_for_ever_is_ended_soon_and_once) {
  const std::string itself = "Procedural \"DelayedReadArchive\" [\"d.rib\"] [-1 1 -1 1 0 1] ";
  file("d.rib", "Disk 0 1 360 " + itself + itself);
  const auto begin = std::chrono::steady_clock::now();
  world(itself);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
  const std::string said = messages();
  EXPECT_THAT(said, HasSubstr("Procedural: DelayedReadArchive \"d.rib\": "));
  EXPECT_THAT(said, HasSubstr("needs an end"));
  EXPECT_EQ(said.find("needs an end"), said.rfind("needs an end"));
  // One that ends itself is not meant, nor the same once more in another world.
  file("e.rib", "Disk 0 1 360 IfBegin \"$user:n != 'xxx'\" "
                "IfBegin \"$user:n == 'xx'\" Attribute \"user\" \"string n\" \"xxx\" IfEnd "
                "IfBegin \"$user:n == 'x'\" Attribute \"user\" \"string n\" \"xx\" IfEnd "
                "Procedural \"DelayedReadArchive\" [\"e.rib\"] [-1 1 -1 1 0 1] "
                "Procedural \"DelayedReadArchive\" [\"e.rib\"] [-1 1 -1 1 0 1] IfEnd");
  EXPECT_EQ(world("Attribute \"user\" \"string n\" \"x\" Procedural \"DelayedReadArchive\" [\"e.rib\"] "
                  "[-1 1 -1 1 0 1]"),
            7u);
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

// ---- In a picture.

class LazyPictures : public ::testing::Test {
protected:
  void SetUp() override {
    folder_.write("ball.rib", "Color 1 0.5 0 Sphere 0.5 -0.5 0.5 360");
    folder_.write("row.rib",
                  fmt::format("{0}Translate 0.6 0 0 {0}", call("ball.rib", "-0.5 0.5 -0.5 0.5 -0.5 0.5")));
  }
  static std::string call(const std::string& archive, const std::string& bound) {
    return fmt::format("Procedural \"DelayedReadArchive\" [\"{}\"] [{}] ", archive, bound);
  }
  std::string scene(const std::string& world) const {
    return fmt::format("Option \"searchpath\" \"archive\" \"{}\" Option \"limits\" \"bucketsize\" [16 16] "
                       "Format 96 64 1 PixelSamples 3 3 Projection \"perspective\" \"fov\" 40 "
                       "WorldBegin Translate 0 0 5 {} WorldEnd",
                       folder_.string(), world);
  }
  static void expect_same(const Rendered& a, const Rendered& b) {
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x)
        ASSERT_EQ(a.Ci(x, y), b.Ci(x, y)) << x << ' ' << y;
  }
  anemone::test::TempFolder folder_;
};

const char* kBoundOfRow = "-0.5 1.1 -0.5 0.5 -0.5 0.5";

TEST_F(LazyPictures, look_as_if_all_were_read_at_once) {
  std::string around =
      "AttributeBegin Translate -0.3 0 0.3 Rotate 30 1 1 0 Torus 0.8 0.2 0 360 360 AttributeEnd ";
  Rendered lazy = render_text(scene(around + call("row.rib", kBoundOfRow)), {}, true);
  EXPECT_EQ(lazy.messages, "");
  EXPECT_EQ(lazy.report.primitives, 3u);
  Rendered eager = render_text(scene(around + "Color 1 0.5 0 Sphere 0.5 -0.5 0.5 360 Translate 0.6 0 0 "
                                              "Sphere 0.5 -0.5 0.5 360"),
                               {}, true);
  EXPECT_GT(eager.covered(), 500);
  expect_same(lazy, eager);
  for (int threads : {1, 3}) {
    FrameSettings s;
    s.threads = threads;
    expect_same(render_text(scene(around + call("row.rib", kBoundOfRow)), s, true), lazy);
  }
}

TEST_F(LazyPictures, what_is_hidden_is_not_opened) {
  std::string wall = "AttributeBegin Translate 0 0 -1 Disk 0 9 360 AttributeEnd ";
  std::string missing = call("none.rib", "-0.5 0.5 -0.5 0.5 -0.5 0.5");
  EXPECT_EQ(render_text(scene(wall + missing)).messages, "");
  EXPECT_EQ(render_text(scene(missing + wall)).messages, "");
  // In front of it, or where culling is off, it is.
  EXPECT_THAT(render_text(scene("Translate 0 0 1 " + wall + "Translate 0 0 -1.4 " + missing)).messages,
              HasSubstr("no archive \"none.rib\""));
  EXPECT_THAT(render_text(scene(wall + "Attribute \"cull\" \"hidden\" 0 " + missing)).messages,
              HasSubstr("no archive \"none.rib\""));
  // In one bucket hidden, in others not: it is made once, and drawn in all.
  std::string half =
      "AttributeBegin Translate 0 0 -1 Polygon \"P\" [-9 -9 0 0 -9 0 0 9 0 -9 9 0] AttributeEnd ";
  Rendered lazy = render_text(scene(half + call("row.rib", kBoundOfRow)), {}, true);
  EXPECT_EQ(lazy.report.primitives, 3u);
  expect_same(lazy, render_text(scene(half + "ReadArchive \"row.rib\""), {}, true));
}

TEST_F(LazyPictures, content_may_move_where_nothing_else_does) {
  folder_.write("moving.rib", "MotionBegin [0 1] Translate -0.4 0 0 Translate 0.4 0 0 MotionEnd "
                              "Sphere 0.3 -0.3 0.3 360");
  std::string shutter = "Shutter 0 1 ";
  Rendered lazy = render_text(shutter + scene(call("moving.rib", "-0.7 0.7 -0.3 0.3 -0.3 0.3")), {}, true);
  Rendered eager = render_text(shutter + scene("ReadArchive \"moving.rib\""), {}, true);
  EXPECT_EQ(lazy.messages, "");
  expect_same(lazy, eager);
  EXPECT_GT(lazy.alpha(38, 32), 0.05f);
  EXPECT_LT(lazy.alpha(38, 32), 0.95f);
}

} // namespace
} // namespace render::testing
