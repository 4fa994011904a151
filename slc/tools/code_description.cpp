// Where a shader comes from and which code belongs to which line, as text: sloinfo --sources and
// --source-map.
#include "slc/tools/shader_description.h"

#include <algorithm>
#include <fmt/format.h>

namespace slc {

std::string_view state_name(slvm::SourceState state) {
  switch (state) {
  case slvm::SourceState::kSame: return "unchanged";
  case slvm::SourceState::kChanged: return "changed";
  case slvm::SourceState::kMissing: break;
  }
  return "not found";
}

std::string sources_as_text(const Inspected& shader) {
  const slvm::Program& p = shader.program;
  std::string text = fmt::format("    compiled by {}\n    source hash {:016x}\n",
                                 p.compiler.empty() ? "an unknown compiler" : p.compiler, p.source_hash);
  for (const slvm::SourceCheck& check : slvm::check_sources(p, shader.path))
    text += fmt::format("    {} {}\n", in_quotes(check.name), state_name(check.state));
  if (p.sources.empty())
    text += fmt::format("    {} without hashes of its files\n", in_quotes(p.source_name));
  return text;
}

// Neighbouring entries of one line are shown as one.
std::string source_map_as_text(const Inspected& shader) {
  const slvm::Program& p = shader.program;
  const SourceLines lines(p, shader.path);
  struct Row {
    std::string range, place, text;
  };
  std::vector<Row> rows;
  for (size_t i = 0, next; i < p.lines.size(); i = next) {
    const slvm::LineEntry& entry = p.lines[i];
    for (next = i + 1; next < p.lines.size(); ++next)
      if (p.lines[next].file != entry.file || p.lines[next].line != entry.line) break;
    size_t end = next < p.lines.size() ? p.lines[next].code : p.code.size();
    rows.push_back({fmt::format("{}-{}", entry.code, end - 1),
                    fmt::format("{}:{}", shader.file_name(entry.file), entry.line),
                    lines.text(entry.file, entry.line)});
  }
  size_t range_width = 0, place_width = 0;
  for (const Row& row : rows) {
    range_width = std::max(range_width, row.range.size());
    place_width = std::max(place_width, row.place.size());
  }
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("    {:>{}}  {:<{}}  {}", row.range, range_width, row.place, place_width, row.text);
    text.resize(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

} // namespace slc
