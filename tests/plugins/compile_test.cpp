// What the compiler says about functions of plug-ins; the programs' options.
#include "tests/plugins/plugged.h"
#include "tests/unit/slc/tool_fixture.h"

namespace slvm::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct PluginCompile : ::testing::Test, Plugged {
  std::string complaint(const std::string& statements) {
    EXPECT_TRUE(compile("surface s() { " + statements + " }").empty()) << statements;
    return diagnostics;
  }
};

TEST_F(PluginCompile, MismatchesNameThePlugin) {
  const std::string library = ", of the plug-in " + plugin_folder("good") + "/points.so\n";
  EXPECT_THAT(complaint("Ci = pt_sum(1, 2);"),
              AllOf(HasSubstr("no 'pt_sum' takes 2 arguments"),
                    HasSubstr("candidate: float pt_sum(float a1)" + library)));
  EXPECT_THAT(complaint("Ci = pt_swap(\"a\", 2);"),
              AllOf(HasSubstr("no 'pt_swap' takes (string, float)"),
                    HasSubstr("candidate: void pt_swap(float a1, float a2)" + library),
                    HasSubstr("'a1' is a float, this is a string")));
}

TEST_F(PluginCompile, OutputsNeedVariables) {
  EXPECT_THAT(complaint("gr_largest(xcomp(P), 5);"), HasSubstr("'most' of 'gr_largest'"));
  EXPECT_THAT(complaint("float v = xcomp(P); gr_largest(xcomp(P), v + 1);"),
              HasSubstr("'most' of 'gr_largest'"));
}

TEST_F(PluginCompile, UniformParametersNeedUniformArguments) {
  EXPECT_THAT(complaint("float k[2] = {1, 2}; gr_fill(xcomp(P), k);"),
              AllOf(HasSubstr("'a1'"), HasSubstr("uniform")));
}

TEST_F(PluginCompile, ArraysOfTheLengthThatIsWanted) {
  EXPECT_THAT(complaint("float k[2] = {1, 2}; color c[1] = {0}; Ci = gr_sum(1, P, N, N, 1, 1, \"\", k, c);"),
              HasSubstr("float[3] a8"));
  EXPECT_THAT(complaint("float f(float k[]) { color c[1] = {0}; return gr_sum(1, P, N, N, 1, 1, \"\", k, c); "
                        "} float k[3] = "
                        "{1, 2, 3}; Ci = f(k);"),
              HasSubstr("no 'gr_sum' takes"));
}

TEST_F(PluginCompile, FunctionsOfTheSourceAndBuiltInsComeFirst) {
  EXPECT_THAT(shade("float pt_sum(float x) { return x + 1; } Ci = pt_sum(1);", 1), ::testing::ElementsAre(2));
  EXPECT_THAT(shade("Ci = sqrt(4);", 1), ::testing::ElementsAre(2));
}

TEST_F(PluginCompile, HeadersAndHintsGiveWayToPlugins) {
  Plugged nothing(std::vector<std::string>{});
  EXPECT_TRUE(nothing.compile("surface s() { Ci = dot(P, P); }").empty());
  EXPECT_THAT(nothing.diagnostics, HasSubstr("RSL writes the dot product a . b"));
}

TEST_F(PluginCompile, ThePluginStatement) {
  EXPECT_FALSE(compile("plugin \"grids\"; surface s() { Ci = gr_sum(1); }").empty()) << diagnostics;
  EXPECT_FALSE(compile("plugin \"points.so\"; surface s() { Ci = pt_sum(1); }").empty()) << diagnostics;
  EXPECT_TRUE(compile("plugin \"nowhere\"; surface s() { Ci = 1; }").empty());
  EXPECT_THAT(diagnostics, AllOf(HasSubstr("test.sl:1:8: error: cannot use the plug-in 'nowhere'"),
                                 HasSubstr("no such library: searched in " + plugin_folder("good") +
                                           "; --dso adds folders")));
  Plugged nothing(std::vector<std::string>{});
  EXPECT_TRUE(nothing.compile("plugin \"grids\"; surface s() { Ci = 1; }").empty());
  EXPECT_THAT(nothing.diagnostics,
              HasSubstr("plug-ins are native code, and only those are used that lie in folders given "
                        "with --dso or in ANEMONE_DSO_PATH"));
  EXPECT_TRUE(compile("plugin \"grids\" surface s() { Ci = 1; }").empty());
  EXPECT_THAT(diagnostics, HasSubstr("expected ';'"));
}

TEST_F(PluginCompile, WithoutASourceOfPluginsTheyAreRefused) {
  const slc::Compiler compiler;
  SourceManager sources;
  Diagnostics diags;
  compiler.compile(sources.add("t.sl", "plugin \"grids\"; surface s() { Ci = 1; }"), {}, sources, diags);
  EXPECT_THAT(format_diagnostics(diags, sources), HasSubstr("this program uses no plug-ins"));
}

TEST_F(PluginCompile, ArraysAreReturnedToArraysOnly) {
  const std::string expected =
      "'gr_array' returns an array: it can only initialise an array, or be assigned to one";
  EXPECT_THAT(complaint("Ci = gr_array(1);"), HasSubstr(expected));
  EXPECT_THAT(complaint("float x = 0; x = gr_array(1);"), HasSubstr(expected));
  EXPECT_THAT(complaint("float a[3] = {1}; a += gr_array(1);"),
              HasSubstr("array 'a' cannot be assigned as a whole"));
  EXPECT_THAT(complaint("float a[3] = gr_array(1, 2);"),
              AllOf(HasSubstr("no 'gr_array' takes 2 arguments"),
                    HasSubstr("candidate: float[] gr_array(uniform float a2), of the plug-in ")));
  EXPECT_THAT(complaint("color a[3] = gr_array(1);"), HasSubstr("no 'gr_array' takes (float)"));
  EXPECT_THAT(complaint("color a[3] = gr_colors(1);"), HasSubstr("no 'gr_colors' takes (float)"));
  EXPECT_THAT(complaint("float a[] = gr_array(1);"), HasSubstr("length"));
}

TEST_F(PluginCompile, ThereAreBoundsToHowManyAreCalled) {
  auto calls = [](unsigned count) { // each stores to other arguments
    std::string text = "float a = 0; ";
    for (unsigned i = 0; i < count; ++i) {
      text += "pt_many(";
      for (unsigned k = 0; k < 13; ++k)
        text += std::string(k ? "," : "") + (i >> k & 1 ? "a" : "1");
      text += ");\n";
    }
    return text;
  };
  EXPECT_FALSE(compile("surface s() { " + calls(4096) + " }").empty()) << diagnostics;
  EXPECT_THAT(complaint(calls(4097)),
              HasSubstr("more than 4096 functions of plug-ins are called, counting what they are "
                        "let store to"));
}

// ---- Programs.

struct PluginTools : slc_test::Tool {
  void SetUp() override {
    write("s.sl", "surface s() {\n  Ci = pt_sum(xcomp(P)) +\n    gr_sum(1) + pt_sum(u);\n}\n");
  }
  std::string folder = plugin_folder("good");
};

TEST_F(PluginTools, TheSwitchAndTheEnvironment) {
  EXPECT_EQ(run("s.sl"), 1);
  EXPECT_THAT(output_, HasSubstr("unknown function 'pt_sum'"));
  for (std::string given :
       {"--dso " + folder, "-dso " + folder, "--dso nowhere:" + folder, "--dso nowhere --dso " + folder})
    EXPECT_EQ(run(given + " s.sl"), 0) << output_;
  EXPECT_EQ(run("s.sl", "ANEMONE_DSO_PATH=nowhere:" + folder), 0) << output_;
}

TEST_F(PluginTools, SloinfoListsThem) {
  ASSERT_EQ(run("-q --dso " + folder + " s.sl"), 0) << output_;
  EXPECT_EQ(sloinfo("-p s.slo"), 0);
  EXPECT_EQ(output_, folder + "/grids.so\n" + folder + "/points.so\n");
  EXPECT_EQ(sloinfo("--uses s"), 0);
  EXPECT_THAT(output_,
              AllOf(HasSubstr("\"gr_sum\" \"float(float x)\" of the plug-in \"" + folder +
                              "/grids.so\": 1 call, s.sl:3"),
                    HasSubstr("\"pt_sum\" \"float(float a1)\" of the plug-in \"" + folder +
                              "/points.so\": 2 calls, s.sl:2,3"),
                    HasSubstr("plug-ins\n        " + folder + "/grids.so " + folder + "/points.so\n")));
  EXPECT_EQ(sloinfo("--json s"), 0);
  EXPECT_THAT(output_,
              AllOf(HasSubstr("\"plugin\": \"" + folder + "/points.so\""), HasSubstr("\"plugins\": [")));
  EXPECT_EQ(sloinfo("--disassemble s"), 0);
  EXPECT_THAT(output_, HasSubstr("pt_sum"));
  EXPECT_EQ(sloinfo("-p s.sl --dso " + folder), 0);
  EXPECT_EQ(output_, folder + "/grids.so\n" + folder + "/points.so\n");
}

TEST_F(PluginTools, SltestRunsThem) {
  const std::string sltest = SLTEST_PROGRAM;
  EXPECT_EQ(run_program(sltest + " s.sl -g 3 1 --dso " + folder), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("Pixel (1, 0):\n  Ci : 20 20 20\n"));
  ASSERT_EQ(run("-q --dso " + folder + " s.sl"), 0) << output_;
  EXPECT_EQ(run_program(sltest + " s.slo -g 3 1"), 1);
  EXPECT_THAT(output_, HasSubstr("'pt_sum' is a function of the plug-in 'points.so', which is not found"));
  EXPECT_EQ(run_program("ANEMONE_DSO_PATH=" + folder + " " + sltest + " --expr 'pt_sum(u)' -g 3 1"), 0)
      << output_;
  EXPECT_THAT(output_, HasSubstr("result : 5\n"));
}

TEST_F(PluginTools, AstAndIrNameThem) {
  EXPECT_EQ(run("--dump=ast --dso " + folder + " s.sl"), 0);
  EXPECT_THAT(output_, HasSubstr("call pt_sum [pt_sum float(float a1) of " + folder + "/points.so]"));
  EXPECT_EQ(run("--dump=ir --dso " + folder + " s.sl"), 0);
  EXPECT_THAT(output_, HasSubstr("call pt_sum"));
}

} // namespace
} // namespace slvm::test
