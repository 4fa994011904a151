// Procedural "DynamicLoad" with real shared libraries, as users of slrender meet it.
#include "tests/render/run_slrender.h"

#include <gmock/gmock.h>

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PlugIns : public anemone::test::SlrenderTest {
protected:
  /// Under the name that plug-ins of users have.
  void plug_in(const std::string& path, const std::string& which) {
    std::filesystem::create_directories((directory_ / path).parent_path());
    std::filesystem::copy_file(std::string(PLUG_INS) + "/" + which + ".so", directory_ / path);
  }
  void scene(const std::string& procedurals, const std::string& options = "") {
    file("a.rib",
         "Display \"a.exr\" \"openexr\" \"rgba\" Format 100 100 1 PixelFilter \"box\" 1 1\n" + options +
             "Projection \"perspective\" \"fov\" [90] Translate 0 0 4 WorldBegin Surface \"constant\"\n" +
             procedurals + "\nWorldEnd");
  }
};

const std::string kBall = "Procedural \"DynamicLoad\" [\"balls.so\" \"0.5 note\"] [-1 1 -1 1 -1 1]";

TEST_F(PlugIns, make_geometry) {
  plug_in("plug/balls.so", "balls");
  scene(kBall + "\nTranslate 100 0 0\n" + kBall);
  Outcome o = run("-procedurals plug a.rib");
  EXPECT_EQ(o.text, "");
  EXPECT_EQ(o.status, 0);
  // The near face of the bound, at a distance of 3: 2 / 3 of half the picture each way.
  EXPECT_EQ(directory_.read("note"), "converted 0.50\ndetail 1111.11\nfreed 0.00\n");
  // The same as without a plug-in.
  file("b.rib", "Display \"b.exr\" \"openexr\" \"rgba\" Format 100 100 1 PixelFilter \"box\" 1 1\n"
                "Projection \"perspective\" \"fov\" [90] Translate 0 0 4 WorldBegin Surface \"constant\"\n"
                "Color 1 0 0 Sphere .5 -.5 .5 360 WorldEnd");
  EXPECT_EQ(run("b.rib").status, 0);
  EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
}

TEST_F(PlugIns, are_found_without_ending_and_by_the_environment) {
  plug_in("plug/balls.so", "balls");
  scene("Procedural \"DynamicLoad\" [\"/elsewhere/balls\" \"0.5 note\"] [-1 1 -1 1 -1 1]");
  ::setenv("ANEMONE_PROCEDURALS", "plug", 1);
  EXPECT_EQ(run("a.rib").text, "");
  ::unsetenv("ANEMONE_PROCEDURALS");
  EXPECT_TRUE(exists("note"));
}

TEST_F(PlugIns, come_only_from_folders_the_user_names) {
  plug_in("plug/balls.so", "balls");
  plug_in("balls.so", "balls");
  scene(kBall, "Option \"searchpath\" \"string procedural\" [\"plug\"]\n");
  Outcome refused = run("--allow-programs a.rib");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text,
              HasSubstr("a.rib:4:1: error: Procedural: DynamicLoad \"balls.so\": plug-ins are loaded "
                        "only from folders named with --procedurals (or in ANEMONE_PROCEDURALS), and "
                        "none is"));
  std::filesystem::create_directories(directory_ / "other");
  EXPECT_THAT(run("-procedurals other a.rib").text,
              HasSubstr("no such plug-in in the folders of --procedurals \"other\"; \""));
  EXPECT_THAT(run("-procedurals other a.rib").text,
              HasSubstr("plug/balls.so\" is not loaded, because only the scene names its folder"));
  EXPECT_FALSE(exists("note"));
}

TEST_F(PlugIns, names_lead_out_of_no_folder) {
  plug_in("other/balls.so", "balls");
  std::filesystem::create_directories(directory_ / "plug");
  std::filesystem::create_symlink(directory_ / "other/balls.so", directory_ / "plug/link.so");
  scene("Procedural \"DynamicLoad\" [\"../other/balls.so\" \"0.5 note\"] [-1 1 -1 1 -1 1]\n"
        "Procedural \"DynamicLoad\" [\"" +
        directory_.string() +
        "/other/balls.so\" \"0.5 note\"] [-1 1 -1 1 -1 1]\n"
        "Procedural \"DynamicLoad\" [\"link.so\" \"0.5 note\"] [-1 1 -1 1 -1 1]");
  Outcome o = run("-procedurals plug a.rib");
  EXPECT_THAT(o.text, HasSubstr("\"../other/balls.so\": no such plug-in"));
  EXPECT_THAT(o.text, HasSubstr("/other/balls.so\": no such plug-in"));
  EXPECT_THAT(o.text, HasSubstr("\"link.so\": no such plug-in"));
  EXPECT_FALSE(exists("note"));
}

TEST_F(PlugIns, may_be_damaged_or_incomplete) {
  plug_in("plug/incomplete.so", "incomplete");
  file("plug/text.so", "not a library");
  scene("Procedural \"DynamicLoad\" [\"incomplete\" \"\"] [-1 1 -1 1 -1 1]\n"
        "Procedural \"DynamicLoad\" [\"incomplete\" \"\"] [-1 1 -1 1 -1 1]\n"
        "Procedural \"DynamicLoad\" [\"text.so\" \"\"] [-1 1 -1 1 -1 1]");
  Outcome o = run("-procedurals plug a.rib");
  EXPECT_EQ(o.status, 1);
  EXPECT_THAT(o.text, HasSubstr("a.rib:3:1: error: Procedural: DynamicLoad \"incomplete\": \""));
  EXPECT_THAT(o.text,
              HasSubstr("plug/incomplete.so\" does not define ConvertParameters, Subdivide; a plug-in has "
                        "ConvertParameters, Subdivide and Free, with C linkage"));
  EXPECT_THAT(o.text, Not(HasSubstr("a.rib:4:1"))) << "said once";
  EXPECT_THAT(o.text,
              HasSubstr("a.rib:5:1: error: Procedural: DynamicLoad \"text.so\": it cannot be loaded: "));
}

TEST_F(PlugIns, may_use_functions_of_their_own_and_make_mistakes) {
  plug_in("plug/balls.so", "balls");
  scene("Procedural \"DynamicLoad\" [\"balls\" \"split\"] [-1 1 -1 1 -1 1]");
  Outcome o = run("-procedurals plug a.rib");
  EXPECT_THAT(o.text, HasSubstr("a.rib:3:1: error: RiSurface: \"Kx\" is not declared"));
  EXPECT_THAT(o.text, HasSubstr("RiDeclare says its type, or the token"));
  double covered = 0;
  std::vector<float> p = pixels("a.exr");
  for (size_t i = 3; i < p.size(); i += 4)
    covered += static_cast<double>(p[i]);
  // A ball of radius 1/4 at a distance of 4: tan(asin(1/16)) * 50 pixels.
  double radius = 50 * std::tan(std::asin(0.25 / 4));
  EXPECT_NEAR(covered, 3.14159265 * radius * radius, 1.5);
}

} // namespace
