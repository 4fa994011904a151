#include "slvm/tools/sltest/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace slvm::sltest {

size_t FileCoverage::lines_run() const {
  return static_cast<size_t>(
      std::count_if(lines.begin(), lines.end(), [](const auto& l) { return l.second > 0; }));
}

size_t FileCoverage::ways_taken() const {
  size_t count = 0;
  for (const BranchCoverage& b : branches)
    count += (b.yes > 0) + (b.no > 0);
  return count;
}

void Coverage::marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) {
  counts_.resize(instrumenter_.marks().size());
  Count& count = counts_[number];
  count.points += step.active_points();
  if (!values.empty())
    for_each_active(step, [&](size_t, size_t i) { count.yes += values[0].planes.get(0, i) != 0; });
}

std::vector<FileCoverage> Coverage::files() const {
  std::map<std::string, FileCoverage> files;
  for (size_t i = 0; i < instrumenter_.marks().size(); ++i) {
    const Mark& m = instrumenter_.marks()[i];
    const Count count = i < counts_.size() ? counts_[i] : Count{};
    std::error_code error;
    if (m.file.ends_with(".toml") || !std::filesystem::exists(m.file, error)) continue;
    FileCoverage& file = files[m.file];
    file.file = m.file;
    if (file.text.empty()) file.text = instrumenter_.files().at(m.file);
    if (m.kind == MarkKind::kStatement) {
      uint64_t& points = file.lines[m.line];
      points = std::max(points, count.points);
    } else if (m.kind == MarkKind::kCondition) {
      file.branches.push_back({m.line, m.column, m.name, count.yes, count.points - count.yes});
    }
  }
  std::vector<FileCoverage> list;
  for (auto& [name, file] : files) {
    std::sort(file.branches.begin(), file.branches.end(),
              [](const BranchCoverage& a, const BranchCoverage& b) {
                return std::pair(a.line, a.column) < std::pair(b.line, b.column);
              });
    list.push_back(std::move(file));
  }
  return list;
}

namespace {

std::string share(size_t part, size_t whole) {
  return whole ? fmt::format("{} of {} ({}%)", part, whole, 100 * part / whole) : "none";
}

/// "3, 7-9": lines with a statement that no point ran. Ranges go over lines without one.
std::string missed_lines(const FileCoverage& f) {
  std::string text;
  for (auto it = f.lines.begin(); it != f.lines.end(); ++it) {
    if (it->second) continue;
    const uint32_t first = it->first;
    while (std::next(it) != f.lines.end() && !std::next(it)->second)
      ++it;
    text += text.empty() ? "" : ", ";
    text += it->first == first ? fmt::format("{}", first) : fmt::format("{}-{}", first, it->first);
  }
  return text;
}

} // namespace

std::string coverage_text(const std::vector<FileCoverage>& files) {
  std::string text = "Coverage\n";
  if (files.empty()) text += "  no source file of a shader was run\n";
  for (const FileCoverage& f : files) {
    text += fmt::format("  {}: lines {}, branches {}\n", f.file, share(f.lines_run(), f.lines.size()),
                        share(f.ways_taken(), 2 * f.branches.size()));
    if (const std::string missed = missed_lines(f); !missed.empty())
      text += fmt::format("    not run: {}\n", missed);
    for (const BranchCoverage& b : f.branches)
      if ((b.yes == 0) != (b.no == 0))
        text += fmt::format("    line {}: {} never {}\n", b.line, b.what, b.yes ? "false" : "true");
  }
  return text;
}

} // namespace slvm::sltest
