// slrender as users run it: options, exit codes, messages.
#include "tests/render/run_slrender.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

using anemone::test::SlrenderTest;

const char* kScene = "Display \"a.png\" \"png\" \"rgba\"\nFormat 32 24 1\nWorldBegin\nTranslate 0 0 5\n"
                     "Sphere 1 -1 1 360\nWorldEnd\n";

TEST_F(SlrenderTest, renders_a_file) {
  file("a.rib", kScene);
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.text, "");
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(SlrenderTest, pictures_and_maps_need_no_modules) {
  // A copy of the program without the modules that hold OpenImageIO and OpenSubdiv.
  fs::copy_file(SLRENDER_PROGRAM, directory_ / "alone");
  auto alone = [&](const std::string& rib) {
    file("a.rib", rib);
    std::FILE* pipe = ::popen(fmt::format("cd '{}' && ./alone a.rib 2>&1", directory_.string()).c_str(), "r");
    std::string text;
    char buffer[4096];
    for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
      text.append(buffer, n);
    ::pclose(pipe);
    return text;
  };
  const std::string scene = "Format 8 8 1 WorldBegin Translate 0 0 5 Sphere 1 -1 1 360 WorldEnd ";
  EXPECT_EQ(alone("Display \"a.png\" \"png\" \"rgba\" Display \"+b\" \"tiff\" \"rgbaz\" " + scene), "");
  EXPECT_TRUE(exists("a.png"));
  EXPECT_TRUE(exists("b.tif"));
  EXPECT_EQ(alone("Display \"a.z\" \"zfile\" \"z\" " + scene + "MakeShadow \"a.z\" \"a.shd\""), "");
  EXPECT_TRUE(exists("a.shd"));
  EXPECT_EQ(alone("Hider \"depthmask\" \"zfile\" \"a.shd\" Display \"c\" \"tiff\" \"rgb\" " + scene), "");
  EXPECT_EQ(
      alone(
          "MakeTexture \"a.png\" \"a.tex\" \"black\" \"clamp\" \"gaussian\" 1 1 "
          "MakeBump \"b.tif\" \"a.bump\" \"black\" \"clamp\" \"box\" 1 1 "
          "MakeLatLongEnvironment \"b.tif\" \"a.env\" \"triangle\" 9 9 "
          "MakeCubeFaceEnvironment \"a.png\" \"a.png\" \"b.tif\" \"a.png\" \"b.tif\" \"a.png\" \"b.env\" 90 "
          "\"box\" 1 1 "),
      "");
  for (const char* name : {"a.tex", "a.bump", "a.env", "b.env"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_THAT(alone("MakeTexture \"none.png\" \"none.tex\" \"black\" \"black\" \"box\" 1 1"),
              HasSubstr("cannot read \"none.png\": there is no such file"));
  EXPECT_THAT(alone("Display \"a.exr\" \"openexr\" \"rgba\" " + scene),
              HasSubstr("without anemone_images.so (OpenImageIO) there are only TIFF and PNG files"));
  EXPECT_THAT(
      alone("Display \"s\" \"tiff\" \"rgb\" WorldBegin SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] "
            "[] [] [] [] \"P\" [0 0 0 1 0 0 1 1 0 0 1 0] WorldEnd"),
      HasSubstr("without anemone_subdivision.so (OpenSubdiv), which belongs beside the program, there "
                "are no subdivision meshes"));
}

TEST_F(SlrenderTest, small_grid_sizes_count_as_64) {
  auto grids = [&](int size) {
    file("a.rib", fmt::format("Option \"limits\" \"gridsize\" [{}] {}", size, kScene));
    const std::string text = run("-statistics a.rib").text;
    const size_t at = text.find("grids");
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(grids(9), grids(64));
  EXPECT_NE(grids(256), grids(64));
}

/// The same map again and again: what is there under its name is always the whole of it.
TEST_F(SlrenderTest, killed_while_it_makes_maps_it_leaves_whole_files) {
  file("image.rib",
       "Format 500 500 1 PixelSamples 1 1 Display \"a.tif\" \"tiff\" \"rgb\" WorldBegin Translate 0 0 5 "
       "Sphere 1 -1 1 360 WorldEnd MakeTexture \"a.tif\" \"a.tex\" \"black\" \"black\" \"box\" 1 1");
  EXPECT_EQ(run("image.rib").status, 0);
  const auto size = fs::file_size(directory_ / "a.tex");
  std::string maps;
  for (int i = 0; i < 200; ++i)
    maps += "MakeTexture \"a.tif\" \"a.tex\" \"black\" \"black\" \"box\" 1 1\n";
  file("maps.rib", maps);
  for (int i = 0; i < 8; ++i) {
    const std::string command = fmt::format("cd '{}' && timeout -s KILL {} '{}' maps.rib",
                                            directory_.string(), 0.05 + 0.043 * i, SLRENDER_PROGRAM);
    EXPECT_NE(std::system(command.c_str()), 0);
    EXPECT_EQ(fs::file_size(directory_ / "a.tex"), size);
  }
}

TEST_F(SlrenderTest, statistics_as_text_and_json) {
  file("a.rib", kScene);
  Outcome o = run("-statistics -statisticsfile s.json -t:1 a.rib");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.text, HasSubstr("frame 0: 32 x 24 pixels, 4 samples each, 1 thread"));
  EXPECT_THAT(o.text, HasSubstr("micropolygons"));
  EXPECT_THAT(o.text, HasSubstr("seconds \"none\""));
  std::ifstream in(directory_ / "s.json");
  std::string json{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(json,
              HasSubstr("{\"version\":1,\"frame\":0,\"width\":32,\"height\":24,\"samples_per_pixel\":4,"));
  EXPECT_THAT(json, HasSubstr("\"primitives\":1,"));
  EXPECT_THAT(json, HasSubstr("\"shaders\":[{\"name\":\"none\","));
  EXPECT_EQ(run("-statisticsfile no/such/folder/s.json a.rib").status, 3);
  file("b.rib", std::string("Option \"statistics\" \"endofframe\" 1\n") + kScene);
  EXPECT_THAT(run("b.rib").text, HasSubstr("frame 0: 32 x 24 pixels"));
}

TEST_F(SlrenderTest, a_killed_render_leaves_no_damaged_file) {
  file("a.rib", "Display \"a.tif\" \"tiff\" \"rgba\"\nFormat 1500 1500 1\nPixelSamples 8 "
                "8\nWorldBegin\nTranslate 0 0 5\n"
                "Sphere 1 -1 1 360\nWorldEnd\n");
  std::string command =
      fmt::format("cd '{}' && timeout -s KILL 0.4 '{}' a.rib", directory_.string(), SLRENDER_PROGRAM);
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_FALSE(exists("a.tif"));
}

/// Whatever is there under the name is complete; what is left under others says whose it was, and the next
/// run removes it.
TEST_F(SlrenderTest, killed_at_any_time_it_leaves_whole_files) {
  // Little to render, much to write: 100 times the same file, and a statistics file.
  std::string scene = "Format 900 700 1 PixelSamples 1 1 PixelFilter \"box\" 1 1\n"
                      "Display \"a.tif\" \"tiff\" \"rgba\" \"string compression\" \"none\"\n";
  for (int i = 0; i < 100; ++i)
    scene += "WorldBegin Translate 0 0 5 ShadingRate 400 Disk 0 1 360 WorldEnd\n";
  file("a.rib", scene);
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    double after = 0.05 + 0.037 * i;
    std::string command = fmt::format("cd '{}' && timeout -s KILL {} '{}' --preview=p.png a.rib >log 2>&1",
                                      directory_.string(), after, SLRENDER_PROGRAM);
    killed += std::system(command.c_str()) != 0;
    EXPECT_TRUE(!exists("a.tif") || fs::file_size(directory_ / "a.tif") > 900u * 700 * 4) << after;
    for (const auto& entry : fs::directory_iterator(directory_)) {
      std::string name = entry.path().filename().string();
      bool known = name == "a.tif" || name == "a.rib" || name == "log" || name == "p.png";
      EXPECT_TRUE(known || name.ends_with(".part")) << name;
    }
  }
  EXPECT_GT(killed, 10);
  // timeout does not wait for what it kills.
  std::this_thread::sleep_for(std::chrono::seconds(1));
  // What a process that is no more has left, and what is somebody else's.
  std::string part;
  for (const auto& entry : fs::directory_iterator(directory_))
    if (entry.path().extension() == ".part") part = entry.path().filename().string();
  file("a.tif.part", "");
  file("a.tif.elsewhere-1.part", "");
  file("b.rib", "Format 9 7 1 Display \"a.tif\" \"tiff\" \"rgba\" WorldBegin WorldEnd");
  EXPECT_EQ(run("--preview=p.png b.rib").status, 0);
  EXPECT_TRUE(exists("a.tif.part"));
  EXPECT_TRUE(exists("a.tif.elsewhere-1.part"));
  EXPECT_TRUE(part.empty() || !exists(part)) << part;
}

TEST_F(SlrenderTest, previews_end_as_the_picture) {
  file("a.rib", std::string("Quantize \"rgba\" 255 0 255 0\n") + kScene);
  Outcome o = run("--preview a.rib"); // the scene is not its file name
  EXPECT_EQ(o.status, 0) << o.text;
  EXPECT_TRUE(exists("preview.png"));
  EXPECT_EQ(run("-preview=look.png -d null a.rib").status, 0);
  EXPECT_TRUE(exists("look.png"));
  EXPECT_THAT(run("--help").text, HasSubstr("--preview=FILE"));
  Outcome bad = run("--preview=no/such/folder/p.png a.rib");
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.text, HasSubstr("cannot write the preview \"no/such/folder/p.png\""));
}

TEST_F(SlrenderTest, the_null_hider_renders_nothing) {
  file("a.rib", std::string("Hider \"null\"\n") + kScene);
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.text, "");
  EXPECT_FALSE(exists("a.png"));
}

TEST_F(SlrenderTest, reads_standard_input_when_no_file_is_given) {
  file("a.rib", kScene);
  EXPECT_EQ(run("< a.rib").status, 0);
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(SlrenderTest, several_files_share_their_state) {
  file("options.rib", "Display \"b.png\" \"png\" \"rgb\"\nFormat 8 8 1\n");
  file("world.rib", "WorldBegin WorldEnd\n");
  EXPECT_EQ(run("options.rib world.rib").status, 0);
  EXPECT_TRUE(exists("b.png"));
}

TEST_F(SlrenderTest, help_and_version_in_all_spellings) {
  for (const char* option : {"-help", "--help", "-h"}) {
    Outcome o = run(option);
    EXPECT_EQ(o.status, 0) << option;
    EXPECT_THAT(o.text, HasSubstr("-progress"));
    EXPECT_THAT(o.text, HasSubstr("Exit status"));
  }
  EXPECT_THAT(run("-version").text, HasSubstr("slrender 0.1.0"));
  EXPECT_EQ(run("--version").status, 0);
}

TEST_F(SlrenderTest, command_line_beats_the_file) {
  file("a.rib", kScene);
  EXPECT_EQ(run("-res 16 12 -crop 0 .5 0 1 -t:2 -d c.tif a.rib").status, 0);
  EXPECT_TRUE(exists("c.tif"));
  EXPECT_FALSE(exists("a.png"));
  EXPECT_EQ(run("-d null -t:all a.rib").status, 0);
  EXPECT_FALSE(exists("a.png"));
  EXPECT_EQ(run("-d ./plain a.rib").status, 0);
  EXPECT_TRUE(exists("plain.tif"));
  file("sub.rib", kScene);
  EXPECT_EQ(run("-cwd . -t:1 sub.rib").status, 0);
}

TEST_F(SlrenderTest, some_frames_of_a_file) {
  std::string scene = "Format 4 4 1\n";
  for (int i = 1; i <= 6; ++i)
    scene += fmt::format(
        "FrameBegin {0}\nDisplay \"f{0}.png\" \"png\" \"rgb\"\nWorldBegin\nWorldEnd\nFrameEnd\n", i);
  // What stands in no frame is made whatever frames are wanted, and a frame left out leaves nothing behind.
  file("a.rib", scene + "Display \"last.png\" \"png\" \"rgb\"\nWorldBegin\nWorldEnd\n");
  auto made = [&](const std::string& arguments) {
    std::string names;
    for (int i = 1; i <= 6; ++i)
      fs::remove(directory_ / fmt::format("f{}.png", i));
    fs::remove(directory_ / "last.png");
    const Outcome o = run(arguments + " a.rib");
    for (int i = 1; i <= 6; ++i)
      if (exists(fmt::format("f{}.png", i))) names += std::to_string(i);
    return fmt::format("{}{}{} {}", names, exists("last.png") ? "+" : "", o.text.empty() ? "" : " " + o.text,
                       o.status);
  };
  EXPECT_EQ(made(""), "123456+ 0");
  EXPECT_EQ(made("-frames 2 4"), "234+ 0");
  EXPECT_EQ(made("--frames 6 9"), "6+ 0");
  EXPECT_EQ(made("-framelist 1,3-5"), "1345+ 0");
  EXPECT_EQ(made("-p:1 -framelist 6"), "6+ 0");
  EXPECT_EQ(made("--framelist=2 -frames 4 4"), "24+ 0");
  EXPECT_EQ(made("-frames 7 9"),
            "+ slrender: error: no frame has one of the numbers asked for with -frames or -framelist\n 1");
  for (const char* wrong : {"1,", "x", "3-", "5-3", "1;2", ",1", "1-2-3"}) {
    const Outcome o = run(fmt::format("-framelist '{}' a.rib", wrong));
    EXPECT_EQ(o.status, 2) << wrong;
    EXPECT_THAT(o.text, HasSubstr("-framelist: expected numbers and ranges such as 1,3-5, found \"" +
                                  std::string(wrong) + "\""));
  }
  EXPECT_THAT(run("-frames 4 2 a.rib").text,
              HasSubstr("-frames: expected the number of the first frame, and of the last"));
  // Blocks and conditions of frames left out are not even looked at; an open one is told.
  file("b.rib", "FrameBegin 1\nIfBegin \"]]\"\nArchiveBegin \"x\"\nFrameEnd\n" + std::string(kScene) +
                    "FrameBegin 2\nFrameEnd\nFrameBegin 3\n");
  const Outcome open = run("-frames 2 2 b.rib");
  EXPECT_THAT(open.text,
              HasSubstr("b.rib:13:1: error: this block, which is left out, is not closed before the end"));
  EXPECT_EQ(open.text.find("b.rib:2"), std::string::npos) << open.text;
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(SlrenderTest, progress_for_people_and_farms) {
  file("a.rib", kScene);
  EXPECT_THAT(run("-Progress a.rib").text, HasSubstr("R90000 100%\n"));
  EXPECT_THAT(run("-progress a.rib").text, HasSubstr("\rR90000 100%\n"));
  EXPECT_THAT(run("-Progress --progressformat 'P={:.0f}' a.rib").text, HasSubstr("P=100\n"));
}

TEST_F(SlrenderTest, programs_of_a_scene_need_the_users_leave) {
  fs::create_directories(directory_ / "tools");
  file("tools/maker", "#!/bin/sh\nwhile read line; do echo Sphere 1 -1 1 360; printf '\\377'; done\n");
  fs::permissions(directory_ / "tools/maker", fs::perms::owner_all);
  file("a.rib", "Display \"a.png\" \"png\" \"rgba\" Format 8 8 1 WorldBegin Translate 0 0 5\n"
                "Procedural \"RunProgram\" [\"maker\" \"\"] [-1 1 -1 1 -1 1] WorldEnd");
  Outcome refused = run("-procedurals tools a.rib");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text, HasSubstr("scenes may run programs only with --allow-programs"));
  Outcome allowed = run("--allow-programs -procedurals tools -program-timeout 5 a.rib");
  EXPECT_EQ(allowed.text, "");
  EXPECT_EQ(allowed.status, 0);
  EXPECT_EQ(run("-program-timeout 0 a.rib").status, 2);
}

TEST_F(SlrenderTest, old_scenes_render_with_warnings) {
  file("shiny.slo", "1\n!surface shiny\n");
  file("shiny.sl", "surface shiny() { Ci = Cs; Oi = 1; }\n");
  file("a.rib",
       "Option \"searchpath\" \"shader\" [\"/usr/local/shaders\"] Display \"a.png\" \"png\" \"rgba\"\n"
       "Format 8 8 1 WorldBegin Surface \"shiny\" \"Kd\" 1 LightSource \"lamp\" 1\n"
       "Translate 0 0 5 Sphere 1 -1 1 360 Surface \"/usr/anna/shiny\" Sphere 1 -1 1 360\n"
       "Surface \"nowhere\" Sphere 1 -1 1 360 Surface \"matte\" Sphere 1 -1 1 360 WorldEnd\n");
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("warning: shiny.slo: not an Anemone .slo file"));
  EXPECT_THAT(o.text, HasSubstr("; shiny.sl is compiled instead"));
  EXPECT_THAT(o.text, HasSubstr("warning: Surface: shader \"shiny\" has no parameter \"Kd\"; it is ignored"));
  EXPECT_THAT(o.text, HasSubstr("warning: LightSource: no shader \"lamp\" in the search path"));
  EXPECT_THAT(o.text, HasSubstr("; it gives no light"));
  EXPECT_THAT(o.text, HasSubstr("; the default surface is drawn instead"));
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(SlrenderTest, a_picture_larger_than_memory_is_not_begun) {
  file("vast.rib", "Display \"vast.tif\" \"tiff\" \"rgbaz\" Display \"+n.tif\" \"tiff\" \"N\" "
                   "Format 65536 65536 1 WorldBegin WorldEnd");
  Outcome o = run("vast.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text,
              HasSubstr("error: a picture of 65536 x 65536 pixels takes 137 GB, and this machine has "));
  EXPECT_THAT(o.text, HasSubstr("rendered with CropWindow or --crop"));
  EXPECT_EQ(run("--crop 0 0.0001 0 0.0001 vast.rib").text, "");
  EXPECT_TRUE(exists("vast.tif"));
}

TEST_F(SlrenderTest, exit_codes) {
  file("bad.rib", "Sphere\nWorldBegin WorldEnd\n");
  Outcome bad = run("-d null bad.rib");
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(
      bad.text,
      HasSubstr("bad.rib:2:1: error: Sphere: expected a number for 'radius', found the request WorldBegin"));
  EXPECT_EQ(run("-nonsense").status, 2);
  EXPECT_EQ(run("-t:many bad.rib").status, 2);
  EXPECT_EQ(run("-crop 1 0 0 1 bad.rib").status, 2);
  Outcome missing = run("nowhere.rib");
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.text, HasSubstr("slrender: error: cannot read \"nowhere.rib\""));
  EXPECT_EQ(run("-cwd nowhere bad.rib").status, 3);
  file("warn.rib", "Frobnicate 1\n");
  EXPECT_EQ(run("warn.rib").status, 0);
  EXPECT_EQ(run("-Werror warn.rib").status, 1);
  EXPECT_EQ(run("-nowarn warn.rib").text, "");
}

TEST_F(SlrenderTest, sources_on_the_search_path_are_compiled) {
  file("glow.sl", "surface glow(float k = 1) { Ci = k; Oi = 1; }\n");
  file("a.rib",
       std::string(kScene).insert(std::string(kScene).find("Sphere"), "Surface \"glow\" \"k\" .5\n"));
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 0) << o.text;
  file("glow.sl", "surface glow(float k = 1) { Ci = kk; Oi = 1; }\n");
  o = run("a.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text, HasSubstr("glow.sl:1:"));
  EXPECT_THAT(o.text, HasSubstr("error: Surface: \"glow.sl\" does not compile"));
}

TEST_F(SlrenderTest, shaders_are_found_in_sources_of_other_names) {
  file("first.sl", "surface second() { Ci = color(0, 1, 0); } /* surface third ( */");
  file("second.sl", "surface first() { Ci = color(1, 0, 0); }");
  file("s.rib", "Display \"s.tif\" \"tiff\" \"rgb\" Format 2 1 1 PixelFilter \"box\" 1 1 ScreenWindow -2 2 "
                "-1 1 WorldBegin "
                "Surface \"first\" Polygon \"P\" [-2 -1 1 0 -1 1 0 1 1 -2 1 1] "
                "Surface \"second\" Polygon \"P\" [0 -1 1 2 -1 1 2 1 1 0 1 1] WorldEnd");
  Outcome o = run("s.rib");
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.text, HasSubstr("first.sl\" defines no shader \"first\"; it is taken from "));
  const auto seen = pixels("s.tif");
  ASSERT_EQ(seen.size(), 6u);
  EXPECT_EQ(seen[0], 1);
  EXPECT_EQ(seen[1], 0);
  EXPECT_EQ(seen[3], 0);
  EXPECT_EQ(seen[4], 1);
  file("other.sl", "volume none() { Ci = 0; }\nsurface   absent\n(float k = 1) { Ci = k; }");
  file("t.rib", "Display \"t.tif\" \"tiff\" \"rgb\" Format 1 1 1 WorldBegin Surface \"absent\" Sphere 1 -1 1 "
                "360 WorldEnd");
  EXPECT_THAT(run("t.rib").text, HasSubstr("warning: there is no \"absent.sl\"; the shader is taken from "));
}

TEST_F(SlrenderTest, a_source_beats_what_is_compiled_in_a_later_folder) {
  // "plastic" is a standard shader; this one is the user's.
  std::filesystem::create_directory(directory_ / "mine");
  file("mine/plastic.sl", "surface plastic() { Ci = color(0, 1, 0); Oi = 1; }");
  file("a.rib",
       "Format 4 4 1 Display \"out.tif\" \"tiff\" \"rgb\" WorldBegin Surface \"plastic\" Translate 0 0 5 "
       "Disk 0 9 360 WorldEnd");
  ASSERT_EQ(run("--shaders mine:@ a.rib").status, 0);
  EXPECT_EQ(pixels("out.tif")[1], 1);
  ASSERT_EQ(run("--shaders @:mine a.rib").status, 0);
  EXPECT_NE(pixels("out.tif")[1], 1);
}

TEST_F(SlrenderTest, sources_that_have_changed_are_compiled_again) {
  auto with = [](const std::string& name) {
    return std::string(kScene).insert(std::string(kScene).find("Sphere"), "Surface \"" + name + "\"\n");
  };
  file("glow.sl", "surface glow() { Ci = 1; Oi = 1; }\n");
  file("a.rib", with("glow"));
  file("b.rib", with("glow.slo"));
  ASSERT_EQ(std::system(fmt::format("cd '{}' && '{}' -q glow.sl", directory_.string(), SLC_PROGRAM).c_str()),
            0);
  EXPECT_EQ(run("a.rib").text, "");
  file("glow.sl", "surface glow() { Ci = 1; Oi = oops; }\n"); // seen, because it is compiled
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text,
              HasSubstr("slrender: warning: glow.slo is older than its source: glow.sl has changed; the "
                        "source is taken\n"));
  EXPECT_THAT(o.text, HasSubstr("unknown variable 'oops'"));
  o = run("b.rib"); // asked for as a file
  EXPECT_EQ(o.status, 0);
  EXPECT_THAT(o.text, HasSubstr("compile it again with slc\n"));
}

TEST_F(SlrenderTest, standard_shaders_are_found_without_a_search_path) {
  file("a.rib", std::string(kScene).insert(std::string(kScene).find("Sphere"),
                                           "LightSource \"ambientlight\" 1 Surface \"plastic\" \"Ks\" .5\n"));
  Outcome o = run("a.rib");
  EXPECT_EQ(o.status, 0) << o.text;
}

} // namespace
