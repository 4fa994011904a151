// The text forms of a preprocessor run.
#include "slc/tools/dependency_file.h"

#include <fmt/format.h>

namespace slc {
namespace {

std::string escaped(std::string_view name) {
  std::string out;
  for (char c : name) {
    if (c == ' ' || c == '#') out += '\\';
    if (c == '$') out += '$';
    out += c;
  }
  return out;
}

} // namespace

std::string make_names(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names)
    out += (out.empty() ? "" : " ") + escaped(name);
  return out;
}

std::string dependency_rule(const std::string& targets, const std::string& source,
                            const std::vector<Dependency>& dependencies, bool with_system) {
  std::string rule = fmt::format("{}: {}", targets, escaped(source));
  for (const Dependency& d : dependencies)
    if (with_system || !d.system) rule += fmt::format(" \\\n  {}", escaped(d.path));
  rule += '\n';
  return rule;
}

std::string with_line_markers(const PreprocessedText& text, const slvm::SourceManager& sources) {
  std::string out;
  slvm::FileId file = 0;
  uint32_t line = 0; // of the source, that the next line of output would have
  size_t piece = 0;
  for (size_t begin = 0; begin < text.text.size();) {
    size_t end = std::min(text.text.find('\n', begin), text.text.size());
    while (piece + 1 < text.pieces.size() && text.pieces[piece + 1].offset <= begin)
      ++piece;
    std::string_view content = std::string_view(text.text).substr(begin, end - begin);
    bool blank = content.find_first_not_of(" \t") == std::string_view::npos;
    // A piece that starts inside the line says where the line is, too.
    size_t p = piece;
    if (!text.pieces.empty() && text.pieces[p].offset < begin && p + 1 < text.pieces.size() &&
        text.pieces[p + 1].offset < end)
      ++p;
    if (!blank && !text.pieces.empty()) {
      const slvm::SourceRange& at = text.pieces[p].at;
      if (at.file == file && at.line > line && at.line - line < 8)
        out.append(at.line - line, '\n');
      else if (at.file != file || at.line != line)
        out += fmt::format("#line {} \"{}\"\n", at.line, sources.name(at.file));
      file = at.file;
      line = at.line;
    }
    if (!blank) {
      out += content;
      out += '\n';
      ++line;
    }
    begin = end + 1;
  }
  return out;
}

} // namespace slc
