// The preprocessor: text, positions, options, old-fashioned source files.
#include "slc/preprocess/normalise.h"
#include "tests/unit/slc/front_end.h"

#include <gtest/gtest.h>

namespace {

using slc_test::Front;

// The token of this text, and where it is: "file:line:column".
std::string place_of(Front& front, const slc::TokenList& list, const std::string& text) {
  for (const slc::Token& t : list.tokens)
    if (t.text == text)
      return std::string(front.sources.name(t.range.file)) + ":" + std::to_string(t.range.line) + ":" +
             std::to_string(t.range.column);
  return "none";
}

TEST(Normalise, keeps_every_character_in_its_column) {
  EXPECT_EQ(slc::normalise_source("a\r\nb\rc"), "a\nb\nc\n");
  EXPECT_EQ(slc::normalise_source("#ifdef X\n#endif X\n"), "#ifdef X\n#endif  \n");
  EXPECT_EQ(slc::normalise_source("#else not X // why\n"), "#else       // why\n");
  EXPECT_EQ(slc::normalise_source("# 12 \"a.h\" 1\n"), "#line  12 \"a.h\"  \n");
  EXPECT_EQ(slc::normalise_source("#define A b \\  \nc\n"), "#define A b   \\\nc\n");
  EXPECT_EQ(slc::normalise_source("/*\n#endif X\n*/\n"), "/*\n#endif X\n*/\n");
  EXPECT_EQ(slc::normalise_source("\xEF\xBB\xBF"
                                  "a\x1a\n"),
            "   a \n");
}

TEST(Preprocess, tokens_know_their_place) {
  Front front;
  front.files["lib.h"] = "float in_header;\n";
  slc::TokenList list =
      front.lex("#include \"lib.h\"\n\t float here;\n#ifdef NEVER\nno\n#endif\n\n  there;\n");
  EXPECT_EQ(place_of(front, list, "in_header"), "lib.h:1:7");
  EXPECT_EQ(place_of(front, list, "here"), "main.sl:2:9");
  EXPECT_EQ(place_of(front, list, "there"), "main.sl:7:3");
  EXPECT_EQ(place_of(front, list, "no"), "none");
}

TEST(Preprocess, macro_bodies_are_placed_at_the_use) {
  Front front;
  slc::TokenList list =
      front.lex("#define TWO(x) body x\n#define ONE inner\na = TWO(argument) + TWO(ONE);\n");
  EXPECT_EQ(place_of(front, list, "body"), "main.sl:3:5");
  EXPECT_EQ(place_of(front, list, "argument"), "main.sl:3:9");
  EXPECT_EQ(place_of(front, list, "inner"), "main.sl:3:21");
}

TEST(Preprocess, continued_lines_keep_their_columns) {
  Front front;
  slc::TokenList list = front.lex("first \\\n   second \\\nthird\n");
  EXPECT_EQ(place_of(front, list, "second"), "main.sl:2:4");
  EXPECT_EQ(place_of(front, list, "third"), "main.sl:3:1");
}

TEST(Preprocess, line_directives_move_positions) {
  Front front;
  slc::TokenList list = front.lex("#line 40 \"other.sl\"\nx\n# 7 \"third.sl\"\ny\n");
  EXPECT_EQ(place_of(front, list, "x"), "other.sl:40:1");
  EXPECT_EQ(place_of(front, list, "y"), "third.sl:7:1");
}

TEST(Preprocess, undefine_wins_over_define) {
  Front front;
  front.options.preprocess.undefines = {"A"};
  front.options.preprocess.defines = {"A=1", "B", "C=2+3", "D(x)=x"};
  slc::PreprocessedText text = front.preprocess("#ifdef A\nno\n#endif\nB C D(4)\n");
  EXPECT_EQ(text.text.find("no"), std::string::npos);
  EXPECT_NE(text.text.find("1 2 + 3 4"), std::string::npos) << text.text;
}

TEST(Preprocess, searches_own_folder_then_include_folders) {
  Front front;
  front.options.preprocess.include_dirs = {"first", "second/"};
  front.options.preprocess.system_dirs = {"third"};
  front.files["first/a.h"] = "#include \"b.h\"\n";
  front.files["first/b.h"] = "beside\n";
  front.files["second/b.h"] = "elsewhere\n";
  front.files["third/c.h"] = "#include \"d.h\"\n";
  front.files["third/d.h"] = "last\n";
  slc::PreprocessedText text = front.preprocess("#include <a.h>\n#include <second.h>\n#include \"c.h\"\n");
  EXPECT_NE(text.text.find("beside"), std::string::npos);
  ASSERT_EQ(text.dependencies.size(), 4u);
  EXPECT_EQ(text.dependencies[0].path, "first/a.h");
  EXPECT_EQ(text.dependencies[2].path, "third/c.h");
  for (size_t i = 0; i < 4; ++i)
    EXPECT_EQ(text.dependencies[i].system, i >= 2) << i;
  EXPECT_EQ(front.messages(), "main.sl:2:10: error: cannot find 'second.h'; searched in 'first/', 'second/', "
                              "'third/' (-I adds a folder)\n"
                              "    2 | #include <second.h>\n      |          ^~~~~~~~~~\n");
}

TEST(Preprocess, stringizing_and_pasting) {
  Front front;
  slc::PreprocessedText text =
      front.preprocess("#define S(x) #x\n#define P(a, b) a##b\nS(hello) P(left, right)\n");
  EXPECT_NE(text.text.find("\"hello\" leftright"), std::string::npos) << text.text;
}

TEST(Preprocess, wrong_files_never_throw) {
  for (const char* text : {"#if\n",
                           "#if 1 +\n#endif\n",
                           "#elif 1\n",
                           "#define\n",
                           "#define f(\nf(",
                           "#define f(x) x\nf(1,2)\n",
                           "#include\n",
                           "#include X\n",
                           "#line\n",
                           "#unknown\n",
                           "#if 1/0\n#endif\n",
                           "#define a a\na\n",
                           "/* open",
                           "\"open",
                           "'",
                           "#",
                           "##",
                           "#undef\n",
                           "#ifdef\n#endif\n",
                           "#if defined(\n#endif\n",
                           "#define f(x) #y\n",
                           "#define X ##\nX\n",
                           "\\",
                           "?"
                           "?=",
                           "#pragma\n",
                           "#pragma  // x\n",
                           "#pragma \\\n\n",
                           "#error\n",
                           "_Pragma(\"\")\n",
                           "#pragma wave\n",
                           ""}) {
    Front front;
    front.preprocess(text);
  }
}

} // namespace
