// Collecting, ordering and printing diagnostics.
#include "slvm/support/diagnostics.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace slvm {

Diagnostic& Diagnostics::error(SourceRange where, std::string text) {
  ++error_count_;
  scrap_ = {};
  if (error_limit && error_count_ > error_limit) return scrap_;
  list_.push_back({Severity::kError, where, std::move(text), "", {}, {}});
  return list_.back();
}

Diagnostic& Diagnostics::warning(SourceRange where, std::string_view name, std::string text) {
  scrap_ = {};
  if (no_warnings || disabled.contains(name) || silenced_.contains({where.file, where.line})) return scrap_;
  if (warnings_are_errors) {
    Diagnostic& d = error(where, std::move(text));
    ++promoted_;
    d.warning_name = fmt::format("error={}", name);
    return d;
  }
  list_.push_back({Severity::kWarning, where, std::move(text), std::string(name), {}, {}});
  return list_.back();
}

void Diagnostics::silence_line(FileId file, uint32_t line) {
  silenced_.insert({file, line});
  std::erase_if(list_, [&](const Diagnostic& d) {
    return d.severity == Severity::kWarning && d.where.file == file && d.where.line == line;
  });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<FileId> file_order;
  auto rank = [&](FileId f) {
    return std::find(file_order.begin(), file_order.end(), f) - file_order.begin();
  };
  for (const Diagnostic& d : list_)
    if (std::find(file_order.begin(), file_order.end(), d.where.file) == file_order.end())
      file_order.push_back(d.where.file);
  std::vector<Diagnostic> out = list_;
  std::stable_sort(out.begin(), out.end(), [&](const Diagnostic& a, const Diagnostic& b) {
    auto key = [&](const Diagnostic& d) {
      return std::tuple(rank(d.where.file), d.where.line, d.where.column);
    };
    return key(a) < key(b);
  });
  return out;
}

namespace {

struct Colours {
  const char *bold, *red, *magenta, *cyan, *green, *off;
};
constexpr Colours kAnsi = {"\033[1m", "\033[1;31m", "\033[1;35m", "\033[1;36m", "\033[1;32m", "\033[0m"};
constexpr Colours kPlain = {"", "", "", "", "", ""};

// The source line and a caret run under the range. Tabs count one column in the caret line too, so they are
// copied.
void append_source_line(std::string& out, SourceRange r, const SourceManager& sources, const Colours& c) {
  std::string_view line = sources.line(r.file, r.line);
  if (line.empty()) return;
  std::string number = fmt::format("{:>5} | ", r.line);
  out += number;
  for (char ch : line)
    out += static_cast<unsigned char>(ch) < 0x20 && ch != '\t' ? ' ' : ch;
  out += '\n';
  out += std::string(number.size() - 2, ' ') + "| ";
  size_t column = r.column == 0 ? 0 : r.column - 1;
  for (size_t i = 0; i < column && i < line.size(); ++i)
    out += line[i] == '\t' ? '\t' : ' ';
  size_t last =
      std::min<size_t>(r.end > r.column ? r.end - 1 : column + 1, std::max(line.size(), column + 1));
  out += c.green;
  out += '^';
  if (last > column + 1) out.append(last - column - 1, '~');
  out += c.off;
  out += '\n';
}

void append_location(std::string& out, SourceRange r, const SourceManager& sources, const Colours& c) {
  if (!r.file && !r.line) return;
  out += c.bold;
  out += sources.name(r.file);
  if (r.line) out += fmt::format(":{}", r.line);
  if (r.line && r.column) out += fmt::format(":{}", r.column);
  out += ": ";
  out += c.off;
}

// What replaces the text above it.
void append_fixits(std::string& out, const Diagnostic& d, const Colours& c) {
  constexpr size_t kMargin = 6; // as wide as the line numbers of source lines
  for (const FixIt& fix : d.fixits) {
    if (fix.where.file != d.where.file || fix.where.line != d.where.line || fix.where.column == 0) continue;
    out += fmt::format("{}| {}{}{}{}\n", std::string(kMargin, ' '), std::string(fix.where.column - 1, ' '),
                       c.green, fix.replacement, c.off);
  }
}

// The files that lead to `file`, the including line of each.
void append_include_stack(std::string& out, FileId file, const SourceManager& sources) {
  std::string_view lead = "In file included from ";
  for (SourceRange at = sources.included_from(file); at.valid(); at = sources.included_from(at.file)) {
    out += fmt::format("{}{}:{}:\n", lead, sources.name(at.file), at.line);
    lead = "                 from ";
  }
}

} // namespace

std::string format_diagnostics(const Diagnostics& diags, const SourceManager& sources, bool colour) {
  const Colours& c = colour ? kAnsi : kPlain;
  std::string out;
  FileId last_file = 0;
  for (const Diagnostic& d : diags.sorted()) {
    if (d.where.file != std::exchange(last_file, d.where.file))
      append_include_stack(out, d.where.file, sources);
    append_location(out, d.where, sources, c);
    bool error = d.severity == Severity::kError;
    out += fmt::format("{}{}:{} {}{}{}", error ? c.red : c.magenta, error ? "error" : "warning", c.off,
                       c.bold, d.text, c.off);
    if (!d.warning_name.empty()) out += fmt::format(" [-W{}]", d.warning_name);
    out += '\n';
    if (d.where.valid()) append_source_line(out, d.where, sources, c);
    append_fixits(out, d, c);
    for (const Note& note : d.notes) {
      append_location(out, note.where, sources, c);
      out += fmt::format("{}note:{} {}\n", c.cyan, c.off, note.text);
      if (note.where.valid()) append_source_line(out, note.where, sources, c);
    }
  }
  if (uint32_t dropped = diags.errors_dropped()) out += fmt::format("{} more errors not shown\n", dropped);
  return out;
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
  std::string_view best;
  size_t best_distance = name.size() < 4 ? 2 : 3; // at most 2 edits, 1 in short names
  std::vector<size_t> row;
  for (std::string_view candidate : candidates) {
    size_t gap =
        candidate.size() > name.size() ? candidate.size() - name.size() : name.size() - candidate.size();
    if (gap >= best_distance) continue;
    row.resize(candidate.size() + 1);
    for (size_t j = 0; j < row.size(); ++j)
      row[j] = j;
    for (size_t i = 1; i <= name.size(); ++i) {
      size_t diagonal = row[0];
      row[0] = i;
      for (size_t j = 1; j < row.size(); ++j) {
        size_t above = row[j];
        row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (name[i - 1] != candidate[j - 1])});
        diagonal = above;
      }
    }
    if (row.back() < best_distance && row.back() < name.size()) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best_distance == 0 ? std::string_view() : best;
}

} // namespace slvm
