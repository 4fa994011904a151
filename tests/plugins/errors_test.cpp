// What is wrong with plug-ins, and what becomes of it: messages name the file and the remedy, nothing stops
// the program.
#include "tests/plugins/plugged.h"
#include "tests/temp_folder.h"

namespace slvm::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct PluginErrors : ::testing::Test {};

TEST_F(PluginErrors, ExceptionsBecomeMessages) {
  Plugged p;
  EXPECT_THAT(p.shade("Ci = gr_throws(xcomp(P));", 3), Each(0.0f));
  EXPECT_THAT(
      p.messages(),
      ElementsAre("1: 'gr_throws' of the plug-in grids.so: it threw an exception: out of cheese (3)"));
}

TEST_F(PluginErrors, AStatusOfFailureBecomesAMessage) {
  Plugged p;
  EXPECT_THAT(p.shade("Ci = gr_fails(xcomp(P));", 3), Each(0.0f));
  EXPECT_THAT(
      p.messages(),
      ElementsAre("1: 'gr_fails' of the plug-in grids.so: it returned 7, which says that it failed (3)"));
}

TEST_F(PluginErrors, CrashesInInitAreContained) {
  Plugged p({plugin_folder("broken/crash_in_init")});
  EXPECT_EQ(p.refusal(p.compile("surface s() { Ci = ci_grid(1); }")),
            "surface \"s\": 'ci_grid' of the plug-in " + plugin_folder("broken/crash_in_init") +
                "/crash_in_init.so cannot be called: in its init it crashed (segmentation fault)");
  // The library is not called any more.
  EXPECT_THAT(p.refusal(p.compile("surface s() { Ci = ci_point(1); }")),
              EndsWith("it crashed (segmentation fault)"));
  Plugged fresh({plugin_folder("broken/crash_in_init")});
  EXPECT_THAT(fresh.shade("Ci = ci_point(xcomp(P));", 3), Each(0.0f));
  EXPECT_THAT(fresh.messages(),
              ElementsAre("1: 'ci_point' of the plug-in crash_in_init.so: in its init it crashed "
                          "(arithmetic error) (3)"));
}

TEST_F(PluginErrors, ExceptionsOfInitAreContained) {
  Plugged p({plugin_folder("broken/throw_in_init")});
  EXPECT_THAT(p.refusal(p.compile("surface s() { Ci = ti_grid(1); }")),
              EndsWith("cannot be called: in its init it threw an exception: no licence"));
  Plugged fresh({plugin_folder("broken/throw_in_init")});
  EXPECT_THAT(fresh.shade("Ci = ti_point(1);", 2), Each(0.0f));
  EXPECT_THAT(
      fresh.messages(),
      ElementsAre("1: 'ti_point' of the plug-in throw_in_init.so: in its init it threw an exception (1)"));
}

TEST_F(PluginErrors, TablesThatPromiseTooMuch) {
  Plugged missing({plugin_folder("broken/missing_function")});
  EXPECT_TRUE(missing.compile("surface s() { Ci = mf_call(1); }").empty());
  EXPECT_THAT(
      missing.diagnostics,
      AllOf(HasSubstr("unknown function 'mf_call'"),
            HasSubstr(
                "missing_function.so: \"float mf_elsewhere(float)\" in the table of 'mf_call': the library "
                "exports no 'mf_elsewhere'; in C++ it needs extern \"C\", which the macros of shadeop.h "
                "bring")));
  Plugged prototype({plugin_folder("broken/bad_prototype")});
  EXPECT_TRUE(prototype.compile("surface s() { Ci = bp_call(1); }").empty());
  EXPECT_THAT(prototype.diagnostics,
              HasSubstr("bad_prototype.so: \"float bp_call(float, quaternion)\" in the table of "
                        "'bp_call': 'quaternion' is no type of the shading language"));
}

TEST_F(PluginErrors, TablesOfOtherHeaders) {
  Plugged foreign({plugin_folder("broken/foreign_table")});
  EXPECT_TRUE(foreign.compile("surface s() { Ci = whatever(1); }").empty());
  EXPECT_THAT(
      foreign.diagnostics,
      HasSubstr(
          "foreign_table.so: its RslPublicFunctions was not compiled with Anemone's RslPlugin.h: compile its "
          "source with that header"));
  Plugged version({plugin_folder("broken/other_version")});
  EXPECT_TRUE(version.compile("surface s() { Ci = whatever(1); }").empty());
  EXPECT_THAT(version.diagnostics,
              HasSubstr("other_version.so: it was compiled with version 77 of RslPlugin.h, this program "
                        "wants version 2: compile it again"));
}

TEST_F(PluginErrors, LibrariesThatLackFunctionsOfOthers) {
  Plugged p({plugin_folder("broken/unresolved")});
  EXPECT_TRUE(p.compile("surface s() { Ci = ur_call(1); }").empty());
  EXPECT_THAT(p.diagnostics,
              HasSubstr("unresolved.so: undefined symbol: function_of_nobody; link the library that has it "
                        "into the plug-in"));
  // The same when a compiled shader is bound.
  Plugged good;
  auto program = read_slo(good.compile("surface s() { Ci = pt_sum(1); }"));
  ASSERT_TRUE(program);
  program->facts.calls.clear();
  program->ir.clear();
  program->plugins = {};
  ASSERT_TRUE(program->plugins.add(
      PluginShadeop::make({"ur_call", "float(float a1)", "unresolved.so", PluginForm::kPointwise})));
  EXPECT_THAT(p.refusal(write_slo(*program)),
              AllOf(HasSubstr("'ur_call' is a function of a plug-in that cannot be used: "),
                    HasSubstr("undefined symbol: function_of_nobody")));
}

TEST_F(PluginErrors, FilesThatAreNoLibraries) {
  anemone::test::TempFolder folder;
  folder.write("text.so", "not a library");
  Plugged p({folder.string()});
  EXPECT_TRUE(p.compile("surface s() { Ci = whatever(1); }").empty());
  EXPECT_THAT(p.diagnostics,
              AllOf(HasSubstr("text.so: "), HasSubstr("it is no shared library for this machine")));
}

TEST_F(PluginErrors, NativeCodeOnlyFromFoldersOfTheUser) {
  Plugged p;
  const std::vector<std::byte> bytes = p.compile("surface s() { Ci = pt_sum(xcomp(P)); }");
  ASSERT_FALSE(bytes.empty());
  Machine trusting_nobody;
  auto shader = trusting_nobody.load(bytes); // its file names the folder that it was compiled with
  ASSERT_TRUE(shader);
  auto instance = trusting_nobody.instantiate(*shader, {});
  ASSERT_FALSE(instance);
  EXPECT_EQ(instance.error(),
            "surface \"s\": 'pt_sum' is a function of the plug-in 'points.so', which is not found: plug-ins "
            "are native "
            "code, and only those are used that lie in folders given with --dso or in ANEMONE_DSO_PATH");
  Machine elsewhere({.plugin_folders = {"nowhere", "lost"}});
  auto other = elsewhere.instantiate(*elsewhere.load(bytes), {});
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error(), EndsWith("which is not found: searched in nowhere, lost; --dso adds folders"));
}

TEST_F(PluginErrors, NamesLeadToNoOtherFolder) {
  const std::vector<std::string> folders{plugin_folder("good")};
  EXPECT_THAT(find_library("points", folders), EndsWith("good/points.so"));
  EXPECT_THAT(find_library("points.so", folders), EndsWith("good/points.so"));
  // A way round that ends in the folder is as good as none; one that ends elsewhere leads nowhere.
  EXPECT_THAT(find_library("../good/points.so", folders), EndsWith("good/points.so"));
  const std::vector<std::string> others{plugin_folder("broken")};
  EXPECT_EQ(find_library("../good/points.so", others), "");
  EXPECT_THAT(find_library("/usr/lib/points.so", folders), EndsWith("good/points.so"));
  EXPECT_EQ(find_library("/usr/lib/libm.so.6", folders), "");
  EXPECT_EQ(find_library("x/../../good/points", others), "");
  EXPECT_EQ(find_library("", folders), "");
}

TEST_F(PluginErrors, AnotherSignatureThanWhenItWasCompiled) {
  Plugged p;
  auto program = read_slo(p.compile("surface s() { Ci = pt_sum(xcomp(P)); }"));
  ASSERT_TRUE(program);
  PluginFunctionName changed = program->plugins.list()[0]->name();
  changed.signature = "float(color a1)";
  program->plugins = {};
  program->facts.calls.clear();
  program->ir.clear();
  ASSERT_TRUE(program->plugins.add(PluginShadeop::make(changed)));
  auto shader = p.machine.load(write_slo(*program));
  ASSERT_FALSE(shader); // the code gives it one plane
  changed.signature = "float(uniform float a1)";
  program->plugins = {};
  ASSERT_TRUE(program->plugins.add(PluginShadeop::make(changed)));
  EXPECT_THAT(p.refusal(write_slo(*program)), HasSubstr("a varying value where a uniform one must be"));
  changed.signature = "float(float a1)";
  changed.form = PluginForm::kGrid;
  program->plugins = {};
  ASSERT_TRUE(program->plugins.add(PluginShadeop::make(changed)));
  EXPECT_THAT(p.refusal(write_slo(*program)),
              AllOf(HasSubstr("points.so has no 'pt_sum' with signature 'float(float a1)' (but "),
                    EndsWith("): compile the shader again")));
}

TEST_F(PluginErrors, DamagedFilesAreRefused) {
  Plugged p;
  const std::vector<std::byte> bytes = p.compile("surface s() { float k[3] = {1, xcomp(P), 3}; color c[2] = "
                                                 "{1, 2}; Ci = gr_sum(1, P, N, N, 1, 1, \"x\", k, c); }");
  ASSERT_FALSE(bytes.empty()) << p.diagnostics;
  auto program = read_slo(bytes);
  ASSERT_TRUE(program);
  for (auto& array : program->arrays)
    if (array.elements == 3 && array.type == Type::kFloat) array.elements = 2; // the function reads three
  EXPECT_THAT(p.refusal(write_slo(*program)), HasSubstr("an array that does not fit 'gr_sum'"));
}

} // namespace
} // namespace slvm::test
