// Compiles every .sl file of this folder and compares its messages with the comments in it:
//   float x = 1.5f; // expect-warning: suffix
// says that on this line, and nowhere else, a warning is given whose text contains "suffix". Several may
// follow each other on a line. All warnings are on. A second test checks that each message of messages.def
// occurs somewhere, a third that each warning of warnings.def is what its example brings about. Where a
// NAME.txt stands beside NAME.sl, it is what slc prints, with carets, notes and fixes.
#include "slc/compiler.h"
#include "slc/diag/messages.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

namespace {

namespace fs = std::filesystem;
using slvm::Diagnostic;
using slvm::Severity;

struct Expectation {
  std::string file;
  uint32_t line = 0;
  Severity severity = Severity::kError;
  std::string text;
  bool met = false;
};

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(DIAGNOSTICS_DIR))
    if (entry.path().extension() == ".sl") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct Outcome {
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
};

const slc::Compiler& compiler() {
  static const slc::Compiler kCompiler;
  return kCompiler;
}

void compile(const std::string& program, Outcome& out) {
  out.diags.error_limit = 1000;
  std::string path = std::string(DIAGNOSTICS_DIR) + "/" + program + ".sl";
  std::optional<std::string> text = slc::read_file(path);
  ASSERT_TRUE(text) << path;
  compiler().check(out.sources.add(path, *text), {}, out.sources, out.diags);
}

// The comments of one line, the last first: each ends where the next begins.
void read_line(const std::string& file, uint32_t line, std::string_view content,
               std::vector<Expectation>& out) {
  constexpr std::string_view kMark = "// expect-";
  for (size_t at; (at = content.rfind(kMark)) != std::string_view::npos; content = content.substr(0, at)) {
    std::string_view comment = content.substr(at + kMark.size());
    size_t colon = comment.find(": ");
    std::string_view text = comment.substr(colon + 2);
    while (text.ends_with(' '))
      text.remove_suffix(1);
    Severity severity = comment.substr(0, colon) == "error" ? Severity::kError : Severity::kWarning;
    out.push_back({file, line, severity, std::string(text)});
  }
}

void read_expectations(const std::string& file, std::string_view text, std::vector<Expectation>& out) {
  uint32_t line = 1;
  for (size_t begin = 0; begin < text.size(); ++line) {
    size_t end = std::min(text.find('\n', begin), text.size());
    read_line(file, line, text.substr(begin, end - begin), out);
    begin = end + 1;
  }
}

class DiagnosticsTest : public testing::TestWithParam<std::string> {};

TEST_P(DiagnosticsTest, says_what_is_expected) {
  Outcome out;
  compile(GetParam(), out);
  std::vector<Expectation> expected;
  for (slvm::FileId id = 1; !out.sources.name(id).empty(); ++id)
    read_expectations(std::string(out.sources.name(id)), out.sources.text(id), expected);
  for (const Diagnostic& d : out.diags.sorted()) {
    auto fits = [&](const Expectation& e) {
      return !e.met && e.line == d.where.line && e.file == out.sources.name(d.where.file) &&
             e.severity == d.severity && d.text.find(e.text) != std::string::npos;
    };
    auto found = std::find_if(expected.begin(), expected.end(), fits);
    if (found != expected.end())
      found->met = true;
    else
      ADD_FAILURE() << "unexpected: " << out.sources.name(d.where.file) << ":" << d.where.line << ":"
                    << d.where.column << ": " << (d.severity == Severity::kError ? "error: " : "warning: ")
                    << d.text;
  }
  for (const Expectation& e : expected)
    if (!e.met) ADD_FAILURE() << "missing: " << e.file << ":" << e.line << ": " << e.text;
}

INSTANTIATE_TEST_SUITE_P(programs, DiagnosticsTest, testing::ValuesIn(programs()),
                         [](const testing::TestParamInfo<std::string>& program) { return program.param; });

// With lines, carets, notes and fixes. The folder is cut from the names of files.
std::string printed(const std::string& program) {
  Outcome out;
  compile(program, out);
  std::string text = slvm::format_diagnostics(out.diags, out.sources);
  std::string folder = std::string(DIAGNOSTICS_DIR) + "/";
  for (size_t at; (at = text.find(folder)) != std::string::npos;)
    text.erase(at, folder.size());
  return text;
}

TEST(Diagnostics, are_printed_as_shown) {
  int compared = 0;
  for (const std::string& program : programs()) {
    std::string path = std::string(DIAGNOSTICS_DIR) + "/" + program + ".txt";
    std::optional<std::string> expected = slc::read_file(path);
    if (!expected) continue;
    ++compared;
    EXPECT_EQ(printed(program), *expected) << path;
  }
  EXPECT_GE(compared, 4);
}

// The fixed parts of a message's text, between its {} fields.
std::vector<std::string> fixed_parts(std::string_view text) {
  std::vector<std::string> parts(1);
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{' && text[i + 1] != '{') {
      i = text.find('}', i);
      parts.emplace_back();
      continue;
    }
    if (text[i] == '{' || text[i] == '}') ++i; // doubled
    parts.back() += text[i];
  }
  return parts;
}

bool made_from(std::string_view text, const std::vector<std::string>& parts) {
  if (parts.size() == 1) return text == parts.front();
  if (!text.starts_with(parts.front()) || !text.ends_with(parts.back())) return false;
  size_t at = parts.front().size();
  for (size_t i = 1; i + 1 < parts.size(); ++i) {
    at = text.find(parts[i], at);
    if (at == std::string_view::npos) return false;
    at += parts[i].size();
  }
  return at + parts.back().size() <= text.size();
}

TEST(Diagnostics, each_message_has_a_program) {
  // Says that our own build is incomplete: no program can bring it about.
  // kNoShader belongs to no line; the example of its warning is its program.
  // kTooManyPlugins and kArrayResult need a plug-in: tests/plugins.
  const std::set<std::string_view> kWithout = {"kNoBody", "kNoShader", "kTooManyPlugins", "kArrayResult"};
  std::vector<std::string> texts;
  for (const std::string& program : programs()) {
    Outcome out;
    compile(program, out);
    for (const Diagnostic& d : out.diags.sorted())
      texts.push_back(d.text);
  }
  for (int i = 0; i < static_cast<int>(slc::Msg::kCount); ++i) {
    const slc::MessageInfo& info = slc::message_info(static_cast<slc::Msg>(i));
    if (kWithout.contains(info.id)) continue;
    std::vector<std::string> parts = fixed_parts(info.text);
    bool seen =
        std::any_of(texts.begin(), texts.end(), [&](const std::string& t) { return made_from(t, parts); });
    EXPECT_TRUE(seen) << "no program in tests/diagnostics brings about " << info.id << ": " << info.text;
  }
}

// The warnings of a program by name; its errors as failures.
std::set<std::string> warnings_of(std::string_view program) {
  Outcome out;
  compiler().check(out.sources.add("example.sl", std::string(program)), {}, out.sources, out.diags);
  EXPECT_FALSE(out.diags.has_errors()) << slvm::format_diagnostics(out.diags, out.sources);
  std::set<std::string> names;
  for (const Diagnostic& d : out.diags.sorted())
    names.insert(d.warning_name);
  return names;
}

TEST(Warnings, have_examples_that_bring_them_about_and_go_away) {
  for (const slc::WarningInfo& w : slc::warnings()) {
    SCOPED_TRACE(w.name);
    EXPECT_EQ(warnings_of(w.example), std::set<std::string>{std::string(w.name)}) << w.example;
    EXPECT_TRUE(warnings_of(w.mended).empty()) << w.mended;
    EXPECT_FALSE(slc::explain_warning(w.name).empty());
  }
}

TEST(Warnings, are_listed_once_and_all_of_them_are_explained) {
  std::set<std::string_view> explained, used;
  for (const slc::WarningInfo& w : slc::warnings())
    EXPECT_TRUE(explained.insert(w.name).second) << w.name;
  for (int i = 0; i < static_cast<int>(slc::Msg::kCount); ++i)
    if (std::string_view name = slc::message_info(static_cast<slc::Msg>(i)).warning_name; !name.empty())
      used.insert(name);
  EXPECT_EQ(explained, used);
  for (const slc::WarningGroup& group : slc::warning_groups())
    for (std::string_view member : group.members)
      EXPECT_TRUE(explained.contains(member)) << group.name << ": " << member;
}

} // namespace
