// The message table, the table of warnings and their groups.
#include "slc/diag/messages.h"

#include <algorithm>
#include <array>

namespace slc {
namespace {

constexpr MessageInfo kMessages[] = {
#define MSG(id, severity, warning_name, text) {#id, slvm::Severity::severity, warning_name, text},
#include "slc/diag/messages.def"
#undef MSG
};

constexpr WarningInfo kWarnings[] = {
#define WARNING(name, on, meaning, reason, example, mended, remedy)                                          \
  {name, on, meaning, reason, example, mended, remedy},
#define WARNING_GROUP(name, members, meaning)
#include "slc/diag/warnings.def"
};

constexpr std::array<std::string_view, 3> kGroups[] = {
#define WARNING(name, on, meaning, reason, example, mended, remedy)
#define WARNING_GROUP(name, members, meaning) {name, members, meaning},
#include "slc/diag/warnings.def"
};

// The names in a group's row: "*" for all, or separated by blanks.
std::vector<std::string_view> members_of(std::string_view row) {
  std::vector<std::string_view> members;
  if (row == "*")
    for (const WarningInfo& w : kWarnings)
      members.push_back(w.name);
  else
    for (size_t end; !row.empty(); row.remove_prefix(std::min(end + 1, row.size()))) {
      end = std::min(row.find(' '), row.size());
      members.push_back(row.substr(0, end));
    }
  return members;
}

// Text in lines of at most `width` columns.
std::string wrapped(std::string_view text, size_t width) {
  std::string out;
  size_t column = 0;
  while (!text.empty()) {
    std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (column > 0) {
      bool fits = column + 1 + word.size() <= width;
      out += fits ? ' ' : '\n';
      column = fits ? column + 1 : 0;
    }
    out += word;
    column += word.size();
  }
  return out + '\n';
}

std::string indented(std::string_view program) {
  std::string out;
  while (!program.empty()) {
    size_t end = program.find('\n') + 1;
    out += fmt::format("    {}", program.substr(0, end));
    program.remove_prefix(end);
  }
  return out;
}

} // namespace

const MessageInfo& message_info(Msg id) {
  return kMessages[static_cast<size_t>(id)];
}

std::span<const WarningInfo> warnings() {
  return kWarnings;
}

const std::vector<WarningGroup>& warning_groups() {
  static const std::vector<WarningGroup> kAll = [] {
    std::vector<WarningGroup> groups;
    for (const auto& [name, members, meaning] : kGroups)
      groups.push_back({name, members_of(members), meaning});
    return groups;
  }();
  return kAll;
}

std::vector<std::string_view> warnings_named(std::string_view name) {
  for (const WarningGroup& group : warning_groups())
    if (group.name == name) return group.members;
  for (const WarningInfo& w : kWarnings)
    if (w.name == name) return {name};
  return {};
}

std::string explain_warning(std::string_view name) {
  constexpr size_t kWidth = 80;
  for (const WarningInfo& w : kWarnings)
    if (w.name == name)
      return fmt::format("-W{0}, {1}\n\n{2}\n{3}\nFor example:\n\n{4}\nInstead:\n\n{5}\n{6}\n", w.name,
                         w.on ? "on unless -Wno-" + std::string(w.name) : "off unless asked for",
                         wrapped(w.meaning, kWidth), wrapped(w.reason, kWidth), indented(w.example),
                         indented(w.mended), wrapped(w.remedy, kWidth));
  for (const WarningGroup& group : warning_groups())
    if (group.name == name) {
      std::string out = fmt::format("-W{}\n\n{}\n", name, wrapped(group.meaning, kWidth));
      for (const WarningInfo& w : kWarnings)
        if (std::find(group.members.begin(), group.members.end(), w.name) != group.members.end())
          out += fmt::format("  {:18} {}\n", w.name, w.meaning);
      return out;
    }
  return {};
}

} // namespace slc
