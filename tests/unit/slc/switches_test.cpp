// Switches of slc that say what is reported, and how: warnings, errors, environment, several files, make
// rules.
#include "tests/unit/slc/tool_fixture.h"

#include <set>
#include <sstream>

namespace {

using slc_test::Tool;

class Switches : public Tool {
protected:
  void SetUp() override {
    Tool::SetUp();
    // unused (on), lint-point and unused-parameter (off), float-condition (on)
    write("w.sl", "surface w(float k = 1, idle = 2) {\n"
                  "  float nothing;\n"
                  "  vector v = P;\n"
                  "  if (k) Ci = length(v);\n"
                  "}\n");
  }
  // The names of the warnings that a command line gives, by [-Wname].
  std::set<std::string> names(const std::string& arguments, const std::string& environment = "") {
    run("-q " + arguments, environment);
    std::set<std::string> found;
    for (size_t at = 0; (at = output_.find("[-W", at)) != std::string::npos; ++at)
      found.insert(output_.substr(at + 3, output_.find(']', at) - at - 3));
    return found;
  }
  using Names = std::set<std::string>;
};

TEST_F(Switches, warnings_by_name_and_group) {
  const Names usual = {"unused", "float-condition"};
  const Names all = {"unused", "float-condition", "lint-point", "unused-parameter"};
  EXPECT_EQ(names("w.sl"), usual);
  EXPECT_EQ(names("-Wall w.sl"), all);
  EXPECT_EQ(names("-strict w.sl"), all);
  EXPECT_EQ(names("-Wstrict w.sl"), all);
  EXPECT_EQ(names("-lint w.sl"), all);
  EXPECT_EQ(names("-Wlint w.sl"), all);
  EXPECT_EQ(names("-lint -nolint w.sl"), usual);
  EXPECT_EQ(names("-lintpoint w.sl"), (Names{"unused", "float-condition", "lint-point"}));
  EXPECT_EQ(names("-lintspace w.sl"), usual);
  EXPECT_EQ(names("-Wunused-parameter w.sl"), (Names{"unused", "float-condition", "unused-parameter"}));
  EXPECT_EQ(names("-Wno-unused w.sl"), Names{"float-condition"});
  EXPECT_EQ(names("-Wno-all w.sl"), Names{});
  EXPECT_EQ(names("-Wno-all -Wunused w.sl"), Names{"unused"});
  EXPECT_EQ(names("-Wall -Wno-lint w.sl"), usual);
  EXPECT_EQ(names("-nw -Wall w.sl"), Names{});
}

TEST_F(Switches, warnings_as_errors) {
  EXPECT_EQ(names("-Werror w.sl"), (Names{"error=unused", "error=float-condition"}));
  EXPECT_EQ(run("-q -Werror w.sl"), 1);
  EXPECT_NE(output_.find("error: variable 'nothing' is not used"), std::string::npos) << output_;
  EXPECT_FALSE(exists("w.slo"));
  EXPECT_EQ(run("-q -Werror -Wno-unused -Wno-float-condition w.sl"), 0) << output_;
  EXPECT_EQ(run("-q -Werror -nw w.sl"), 0) << output_;
  EXPECT_EQ(run("-q -Werror -Wno-error w.sl"), 0) << output_;
  EXPECT_TRUE(exists("w.slo"));
}

TEST_F(Switches, warnings_as_errors_in_json) {
  EXPECT_EQ(run("-q -Werror --diagnostics=json w.sl"), 1);
  EXPECT_NE(output_.find("{\"severity\":\"error\",\"message\":\"variable 'nothing' is not "
                         "used\",\"warning\":\"error=unused\","),
            std::string::npos)
      << output_;
}

TEST_F(Switches, nolint_silences_the_next_statement_only) {
  write("n.sl", "surface n() {\n#pragma nolint\n  float a =\n    1;\n  float b = 1;\n}\n");
  EXPECT_EQ(run("-q n.sl"), 0);
  EXPECT_EQ(output_.find("'a'"), std::string::npos) << output_;
  EXPECT_NE(output_.find("n.sl:5:9: warning: variable 'b' is set but never read [-Wunused]"),
            std::string::npos)
      << output_;
}

TEST_F(Switches, unknown_warnings_name_the_nearest) {
  EXPECT_EQ(run("-Wunusd w.sl"), 2);
  EXPECT_NE(output_.find("there is no warning 'unusd'; did you mean 'unused'?"), std::string::npos)
      << output_;
  EXPECT_EQ(run("-Wno-unusd w.sl"), 2);
  EXPECT_NE(output_.find("did you mean 'no-unused'?"), std::string::npos) << output_;
  EXPECT_EQ(run("-Wnonsense w.sl"), 2);
  EXPECT_NE(output_.find("--explain all lists them"), std::string::npos) << output_;
}

TEST_F(Switches, explain_tells_what_a_warning_means) {
  EXPECT_EQ(run("--explain unused"), 0);
  EXPECT_EQ(output_.substr(0, output_.find('\n')), "-Wunused, on unless -Wno-unused");
  EXPECT_NE(output_.find("\nFor example:\n\n    surface s() {\n"), std::string::npos) << output_;
  EXPECT_NE(output_.find("\nInstead:\n\n"), std::string::npos) << output_;
  EXPECT_EQ(run("--explain lint"), 0);
  EXPECT_NE(output_.find("\n  lint-space "), std::string::npos) << output_;
  EXPECT_EQ(run("--explain all"), 0);
  EXPECT_NE(output_.find("\n  escape "), std::string::npos) << output_;
  EXPECT_EQ(run("--explain nothing"), 2);
}

TEST_F(Switches, the_environment_comes_first) {
  EXPECT_EQ(names("w.sl", "SLC_OPTIONS='-Wall -Wno-unused'"),
            (Names{"float-condition", "lint-point", "unused-parameter"}));
  EXPECT_EQ(names("-Wunused w.sl", "SLC_OPTIONS=-Wno-all"), Names{"unused"});
  write("lib/deep.h", "#define DEEP 2\n");
  write("own/deep.h", "#define DEEP 3\n");
  write("i.sl", "#include \"deep.h\"\n#if DEEP != WANTED\n#error\n#endif\nsurface i() { Ci = DEEP; }\n");
  EXPECT_EQ(run("-q -DWANTED=2 i.sl"), 1);
  EXPECT_EQ(run("-q -DWANTED=2 i.sl", "SLC_INCLUDE=nowhere:lib"), 0) << output_;
  EXPECT_EQ(run("-q -DWANTED=2 i.sl", "SLC_INCLUDE='nowhere;lib'"), 0) << output_;
  EXPECT_EQ(run("-q -DWANTED=3 -Iown i.sl", "SLC_INCLUDE=lib"), 0) << output_;
}

TEST_F(Switches, several_files_end_with_a_summary) {
  write("good.sl", "surface good() {}");
  write("bad.sl", "surface bad() { Ci = nobody; }");
  EXPECT_EQ(run("-q bad.sl good.sl absent.sl w.sl"), 3);
  EXPECT_NE(output_.find("slc: 2 of 4 files failed:\n    bad.sl\n    absent.sl\n"), std::string::npos)
      << output_;
  EXPECT_TRUE(exists("good.slo") && exists("w.slo"));
  EXPECT_EQ(run("-q good.sl bad.sl"), 1);
  EXPECT_EQ(run("-q good.sl w.sl"), 0);
  EXPECT_EQ(output_.find("failed"), std::string::npos);
}

TEST_F(Switches, standard_input_and_output) {
  EXPECT_EQ(run("-q -nw - < w.sl"), 0) << output_;
  EXPECT_TRUE(exists("w.slo"));
  EXPECT_EQ(run("-nw -o - - < w.sl > piped.slo"), 0) << output_;
  EXPECT_EQ(read("piped.slo"), read("w.slo"));
  write("bad.sl", "surface bad() { Ci = nobody; }");
  EXPECT_EQ(run("- < bad.sl"), 1);
  EXPECT_EQ(output_.substr(0, 13), "<stdin>:1:22:");
}

// What a make rule names, behind its target.
std::vector<std::string> prerequisites(const std::string& rule) {
  std::istringstream words(rule.substr(rule.find(": ") + 2));
  std::vector<std::string> names;
  for (std::string word; words >> word;) {
    if (word == "\\" || word.ends_with("stdc-predef.h")) continue; // the C compiler's own
    names.push_back(word.starts_with("./") ? word.substr(2) : word);
  }
  return names;
}

TEST_F(Switches, make_rules_name_what_the_c_compiler_names) {
  write("a.sl",
        "#include \"b.h\"\n#include <c.h>\n#include \"sub/d.h\"\n#ifdef NEVER\n#include \"f.h\"\n#endif\n"
        "surface a() { Ci = 1; }\n");
  write("b.h", "#include \"e.h\"\n");
  write("e.h", "");
  write("inc/c.h", "#include \"g.h\"\n");
  write("inc/g.h", "");
  write("sub/d.h", "#include \"x.h\"\n#include \"../e.h\"\n");
  write("sub/x.h", "");
  for (const char* flags : {"-M -Iinc", "-MM -Iinc", "-M -I inc -MT 'some thing'", "-MM -I. -Iinc -MT x"}) {
    SCOPED_TRACE(flags);
    ASSERT_EQ(run_program(std::string(CXX_PROGRAM) + " -x c++ " + flags + " a.sl"), 0) << output_;
    std::string wanted = output_;
    ASSERT_EQ(run(std::string(flags) + " a.sl"), 0) << output_;
    EXPECT_EQ(prerequisites(output_), prerequisites(wanted)) << output_ << wanted;
    if (wanted.starts_with("a.o")) wanted.replace(0, 3, "a.slo");
    EXPECT_EQ(output_.substr(0, output_.find(':')), wanted.substr(0, wanted.find(':')));
  }
}

TEST_F(Switches, make_rules_beside_the_output) {
  write("a.sl", "#include \"b.h\"\nsurface first() { Ci = 1; }\n");
  write("b.h", "");
  std::filesystem::create_directory(folder_ / "out");
  EXPECT_EQ(run("-q -MD -o out/given.slo a.sl"), 0) << output_;
  EXPECT_EQ(read("out/given.d"), "out/given.slo: a.sl \\\n  b.h\n");
  EXPECT_EQ(run("-q -MD -d out a.sl"), 0) << output_;
  EXPECT_EQ(read("out/first.d"), "out/first.slo: a.sl \\\n  b.h\n");
  EXPECT_EQ(run("-q -MD -MF rules -MT 'one two' a.sl"), 0) << output_;
  EXPECT_EQ(read("rules"), "one two: a.sl \\\n  b.h\n");
  EXPECT_TRUE(exists("first.slo"));
  EXPECT_EQ(run("-M -MF rules a.sl"), 0) << output_;
  EXPECT_EQ(read("rules"), "a.slo: a.sl \\\n  b.h\n");
  write("a.sl", "#include \"gone.h\"\n");
  EXPECT_EQ(run("-M a.sl"), 1);
  EXPECT_NE(output_.find("cannot find 'gone.h'"), std::string::npos) << output_;
}

} // namespace
