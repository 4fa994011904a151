// The message table, and groups of warnings.
#include "slc/diag/messages.h"

#include <algorithm>

namespace slc {
namespace {

constexpr MessageInfo kMessages[] = {
#define MSG(id, severity, warning_name, text) {#id, slvm::Severity::severity, warning_name, text},
#include "slc/diag/messages.def"
#undef MSG
};

} // namespace

const MessageInfo& message_info(Msg id) {
  return kMessages[static_cast<size_t>(id)];
}

const std::vector<WarningGroup>& warning_groups() {
  static const std::vector<WarningGroup> kGroups = [] {
    WarningGroup all{"all", {}};
    for (const MessageInfo& info : kMessages)
      if (!info.warning_name.empty() &&
          std::find(all.members.begin(), all.members.end(), info.warning_name) == all.members.end())
        all.members.push_back(info.warning_name);
    return std::vector<WarningGroup>{
        all,
        {"lint", {"lint-point", "lint-space", "unused-parameter"}},
        {"strict", all.members},
    };
  }();
  return kGroups;
}

const std::vector<std::string_view>& warnings_off_by_default() {
  static const std::vector<std::string_view> kOff = {"lint-point", "lint-space", "unused-parameter"};
  return kOff;
}

std::vector<std::string_view> warnings_named(std::string_view name) {
  std::vector<std::string_view> found;
  const std::vector<WarningGroup>& groups = warning_groups();
  for (const WarningGroup& group : groups)
    if (group.name == name) return group.members;
  const std::vector<std::string_view>& all = groups.front().members;
  if (std::find(all.begin(), all.end(), name) != all.end()) found.push_back(name);
  return found;
}

} // namespace slc
