// The programs in the documents are true: every ```rsl block of docs/*.md is compiled. Comments
// "error: text" and "warning: text" in a block say what the compiler says of their line; anything else is a
// failure. A block marked ```rsl statements stands in a surface of its own. In warnings.md, whose table has
// its own test, only errors count. And docs/embedding.md shows the program of tests/external as it is.
#include "slc/compiler.h"
#include "slvm/plugin/finder.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using slvm::Diagnostic;
using slvm::Severity;

struct Block {
  std::string document;
  size_t line = 0; // of its first line
  std::string text;
  bool statements = false;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t begin = 0; begin < text.size();) {
    size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::vector<Block> blocks() {
  std::vector<Block> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(DOCS_DIR)) {
    if (entry.path().extension() != ".md") continue;
    if (entry.path().filename() == "subsurface.md" && !fs::exists(PLUGIN_FOLDER)) continue; // its functions
    std::vector<std::string> lines = lines_of(slc::read_file(entry.path().string()).value_or(""));
    for (size_t i = 0; i < lines.size(); ++i) {
      if (!lines[i].starts_with("```rsl")) continue;
      Block block{entry.path().filename().string(), i + 2, "", lines[i] == "```rsl statements"};
      for (++i; i < lines.size() && lines[i] != "```"; ++i)
        block.text += lines[i] + "\n";
      found.push_back(std::move(block));
    }
  }
  return found;
}

// "error: text" or "warning: text" of each line that says so.
std::vector<std::pair<size_t, std::string>> expectations(const std::string& text) {
  std::vector<std::pair<size_t, std::string>> found;
  std::vector<std::string> lines = lines_of(text);
  for (size_t i = 0; i < lines.size(); ++i)
    for (std::string_view kind : {"// error: ", "// warning: "})
      if (size_t at = lines[i].find(kind); at != std::string::npos)
        found.emplace_back(i + 1, lines[i].substr(at + 3));
  return found;
}

void check(const slc::Compiler& compiler, const Block& block) {
  // The head stands on the first line, so that lines keep their numbers.
  std::string text = block.statements ? "surface example() { " + block.text + "}\n" : block.text;
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
  slc::CompileOptions options;
  const slvm::PluginFinder plugins({PLUGIN_FOLDER});
  options.plugins = &plugins;
  compiler.compile(sources.add("block.sl", text), options, sources, diags);
  auto expected = expectations(block.text);
  for (const Diagnostic& d : diags.sorted()) {
    bool error = d.severity == Severity::kError;
    auto fits = [&](const auto& e) {
      std::string_view said = e.second;
      bool kind = said.starts_with(error ? "error: " : "warning: ");
      return kind && e.first == d.where.line &&
             d.text.find(said.substr(said.find(' ') + 1)) != std::string::npos;
    };
    auto it = std::find_if(expected.begin(), expected.end(), fits);
    if (it != expected.end())
      expected.erase(it);
    else if (error || block.document != "warnings.md")
      ADD_FAILURE() << fmt::format("docs/{}:{}: ", block.document, block.line + d.where.line - 1) << d.text;
  }
  for (const auto& [line, said] : expected)
    ADD_FAILURE() << fmt::format("docs/{}:{}: missing: ", block.document, block.line + line - 1) << said;
}

TEST(Documents, have_programs_that_compile) {
  slc::Compiler compiler;
  size_t checked = 0;
  for (const Block& block : blocks()) {
    check(compiler, block);
    ++checked;
  }
  EXPECT_GE(checked, 50u);
}

/// A page with a program and how it is built, both as they are in a folder of tests.
void expect_shown(const std::string& page_name, const std::string& folder, const std::string& program_name,
                  const std::string& language) {
  std::string page = slc::read_file(DOCS_DIR "/" + page_name).value_or("");
  std::string program = slc::read_file(folder + "/" + program_name).value_or("none");
  EXPECT_NE(page.find("```" + language + "\n" + program + "```"), std::string::npos)
      << "copy " << folder << "/" << program_name;
  std::string lists = slc::read_file(folder + "/CMakeLists.txt").value_or("none");
  size_t begin = page.find("```cmake\n");
  ASSERT_NE(begin, std::string::npos);
  begin = page.find('\n', begin) + 1;
  std::string shown = page.substr(begin, page.find("```", begin) - begin);
  EXPECT_NE(lists.find(shown), std::string::npos) << "copy from " << folder << "/CMakeLists.txt";
}

TEST(Documents, show_the_program_that_embeds_us) {
  expect_shown("embedding.md", TESTS_DIR "/external", "shade_grid.cpp", "cpp");
}

TEST(Documents, show_the_program_in_c) {
  expect_shown("c-interface.md", TESTS_DIR "/c_interface", "draw.c", "c");
}

} // namespace
