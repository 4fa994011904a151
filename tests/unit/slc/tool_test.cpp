// The slc program, as its users run it.
#include "tests/unit/slc/tool_fixture.h"

namespace {

namespace fs = std::filesystem;
using slc_test::Tool;

TEST_F(Tool, output_is_named_after_the_shader) {
  write("x.sl", "surface plastic() { Ci = 1; } surface metal() { Ci = 2; }");
  EXPECT_EQ(run("x.sl"), 0) << output_;
  EXPECT_EQ(output_, "surface \"plastic\" -> plastic.slo\nsurface \"metal\" -> metal.slo\n");
  EXPECT_TRUE(exists("plastic.slo") && exists("metal.slo"));
  EXPECT_EQ(run("-o both.slo x.sl"), 2);
  fs::create_directory(folder_ / "out");
  EXPECT_EQ(run("-q -d out x.sl"), 0);
  EXPECT_EQ(output_, "");
  EXPECT_TRUE(exists("out/metal.slo"));
}

TEST_F(Tool, exit_codes) {
  write("good.sl", "surface good() {}");
  write("bad.sl", "surface bad() { x }");
  EXPECT_EQ(run("good.sl"), 0);
  EXPECT_EQ(run("bad.sl"), 1);
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("--no-such-option good.sl"), 2);
  EXPECT_EQ(run("-Wnonsense good.sl"), 2);
  EXPECT_EQ(run("absent.sl"), 3);
  EXPECT_EQ(run("--help"), 0);
  EXPECT_EQ(run("--version"), 0);
}

TEST_F(Tool, goes_on_after_a_failure) {
  write("shaders/a.sl", "surface a() { x }");
  write("shaders/deep/b.sl", "surface b() {}");
  EXPECT_EQ(run("-q shaders"), 1);
  EXPECT_NE(output_.find("slc: 1 of 2 files failed:\n    shaders/a.sl\n"), std::string::npos) << output_;
  EXPECT_TRUE(exists("b.slo"));
}

TEST_F(Tool, macros_and_include_folders_in_both_spellings) {
  write("inc/k.h", "#define K 1\n");
  write("a.sl", "#include \"k.h\"\n#if A != 2 || !defined(B) || defined(C) || "
                "!defined(ANEMONE)\n#error\n#endif\nsurface a() { Ci = K; }");
  EXPECT_EQ(run("-Iinc -DA=2 -D B -DC -UC a.sl"), 0) << output_;
  EXPECT_EQ(run("-I inc -D A=2 -DB -U C -D C a.sl"), 0) << output_;
}

TEST_F(Tool, standard_input_has_a_name) {
  EXPECT_EQ(run("-s given.sl - < /dev/null"), 0);
  write("bad.sl", "surface bad() { x }");
  EXPECT_EQ(run("-s given.sl - < bad.sl"), 1);
  EXPECT_EQ(output_.substr(0, 8), "given.sl");
}

TEST_F(Tool, dependencies) {
  write("a.sl", "#include \"b.h\"\n#include <c.h>\nsurface a() {}");
  write("b.h", "");
  write("c.h", "");
  EXPECT_EQ(run("-M -I. a.sl"), 0);
  EXPECT_EQ(output_, "a.slo: a.sl \\\n  b.h \\\n  ./c.h\n");
  EXPECT_EQ(run("-MM -I. -MT target a.sl"), 0);
  EXPECT_EQ(output_, "target: a.sl \\\n  b.h \\\n  ./c.h\n");
  EXPECT_EQ(run("-q -MMD -MF deps a.sl", "SLC_INCLUDE=."), 0) << output_;
  EXPECT_EQ(read("deps"), "a.slo: a.sl \\\n  b.h\n");
}

TEST_F(Tool, warnings_have_switches) {
  write("a.sl", "surface a() { float f = 1; }");
  EXPECT_EQ(run("-q a.sl"), 0);
  EXPECT_NE(output_.find("[-Wunused]"), std::string::npos) << output_;
  EXPECT_EQ(run("-q -Wno-unused a.sl"), 0);
  EXPECT_EQ(output_, "");
  EXPECT_EQ(run("-q -nw a.sl"), 0);
  EXPECT_EQ(output_, "");
  EXPECT_EQ(run("-q -Werror a.sl"), 1);
}

class Messages : public Tool {
protected:
  void SetUp() override {
    Tool::SetUp();
    write("outer.h", "#include \"inner.h\"\n");
    write("inner.h", "float twice(float x) { return 2 * y; }\n");
    write("x.sl", "#define HALF(a) ((a) * hlaf)\n#include \"outer.h\"\nsurface a(float half = 0.5) {\n"
                  "  float k = HALF(2);\n  Ci = smothstep(0, 1, k);\n}\n");
  }
};

TEST_F(Messages, tell_the_way_through_includes_and_macros_and_show_fixes) {
  EXPECT_EQ(run("x.sl"), 1);
  EXPECT_EQ(output_, "In file included from outer.h:1:\n"
                     "                 from x.sl:2:\n"
                     "inner.h:1:35: error: unknown variable 'y'\n"
                     "    1 | float twice(float x) { return 2 * y; }\n"
                     "      |                                   ^\n"
                     "x.sl:4:13: error: unknown variable 'hlaf'; did you mean 'half'?\n"
                     "    4 |   float k = HALF(2);\n"
                     "      |             ^~~~\n"
                     "x.sl:1:9: note: in the expansion of macro 'HALF', which is defined here\n"
                     "    1 | #define HALF(a) ((a) * hlaf)\n"
                     "      |         ^~~~\n"
                     "x.sl:5:8: error: unknown function 'smothstep'; did you mean 'smoothstep'?\n"
                     "    5 |   Ci = smothstep(0, 1, k);\n"
                     "      |        ^~~~~~~~~\n"
                     "      |        smoothstep\n");
}

TEST_F(Messages, come_as_json) {
  EXPECT_EQ(run("--diagnostics=json x.sl"), 1);
  EXPECT_EQ(
      output_,
      "{\"severity\":\"error\",\"message\":\"unknown variable 'y'\",\"at\":{\"file\":\"inner.h\",\"line\":1,"
      "\"column\":35,\"end\":36},\"included_from\":[{\"file\":\"outer.h\",\"line\":1,\"column\":10,\"end\":"
      "19},"
      "{\"file\":\"x.sl\",\"line\":2,\"column\":10,\"end\":19}]}\n"
      "{\"severity\":\"error\",\"message\":\"unknown variable 'hlaf'; did you mean "
      "'half'?\",\"at\":{\"file\":\"x.sl\","
      "\"line\":4,\"column\":13,\"end\":17},\"notes\":[{\"message\":\"in the expansion of macro 'HALF', "
      "which is "
      "defined here\",\"at\":{\"file\":\"x.sl\",\"line\":1,\"column\":9,\"end\":13}}]}\n"
      "{\"severity\":\"error\",\"message\":\"unknown function 'smothstep'; did you mean "
      "'smoothstep'?\",\"at\":{\"file\":"
      "\"x.sl\",\"line\":5,\"column\":8,\"end\":17},\"fixits\":[{\"at\":{\"file\":\"x.sl\",\"line\":5,"
      "\"column\":8,"
      "\"end\":17},\"replacement\":\"smoothstep\"}]}\n");
  write("w.sl", "surface w() { float k = 1; Ci = 1; }");
  EXPECT_EQ(run("-q --diagnostics=json w.sl"), 0);
  EXPECT_EQ(
      output_,
      "{\"severity\":\"warning\",\"message\":\"variable 'k' is set but never read\",\"warning\":\"unused\","
      "\"at\":{\"file\":\"w.sl\",\"line\":1,\"column\":21,\"end\":22}}\n");
}

TEST_F(Messages, end_at_a_limit) {
  std::string many = "surface m() {\n";
  for (int i = 0; i < 30; ++i)
    many += "  Ci = nobody" + std::to_string(i) + ";\n";
  write("m.sl", many + "}\n");
  auto errors = [&] {
    size_t count = 0;
    for (size_t at = output_.find("error:"); at != std::string::npos; at = output_.find("error:", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(run("m.sl"), 1);
  EXPECT_EQ(errors(), 20u);
  EXPECT_NE(output_.find("10 more errors not shown\n"), std::string::npos);
  EXPECT_EQ(run("--error-limit 3 m.sl"), 1);
  EXPECT_EQ(errors(), 3u);
  EXPECT_EQ(run("--error-limit 0 m.sl"), 1);
  EXPECT_EQ(errors(), 30u);
  EXPECT_EQ(run("--error-limit 1 --diagnostics=json m.sl"), 1);
  EXPECT_NE(output_.find("{\"errors_not_shown\":29}\n"), std::string::npos) << output_;
}

TEST_F(Tool, preprocessed_text_compiles_to_the_same) {
  write("lib.h", "float half(float x) { return x / 2; }\n");
  write("a.sl", "#include \"lib.h\"\n#define K 3\nsurface a()\n{\n\n\n  Ci = half(K); }\n");
  ASSERT_EQ(run("-E -o pre.sl a.sl"), 0) << output_;
  EXPECT_NE(read("pre.sl").find("#line 3 \"a.sl\""), std::string::npos) << read("pre.sl");
  EXPECT_EQ(run("-q pre.sl"), 0) << output_;
}

TEST_F(Tool, dumps_every_stage) {
  write("a.sl", "surface a() { Ci = 1; }");
  for (const char* stage : {"ast", "ir", "bytecode"}) {
    EXPECT_EQ(run(std::string("--dump=") + stage + " a.sl"), 0);
    EXPECT_NE(output_.find("a"), std::string::npos);
    EXPECT_FALSE(exists("a.slo"));
  }
}

} // namespace
