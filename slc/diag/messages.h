// The compiler's messages by name, and how to report one. The texts are in messages.def.
#pragma once

#include "slvm/support/diagnostics.h"

#include <fmt/format.h>

namespace slc {

enum class Msg : uint16_t {
#define MSG(id, severity, warning_name, text) id,
#include "slc/diag/messages.def"
#undef MSG
  kCount
};

struct MessageInfo {
  std::string_view id;
  slvm::Severity severity;
  std::string_view warning_name; ///< "" for errors
  std::string_view text;         ///< a fmt format string
};
const MessageInfo& message_info(Msg);

/// A name for several warnings, usable wherever the name of one is.
struct WarningGroup {
  std::string_view name;
  std::vector<std::string_view> members;
};
/// "all", "lint", "strict" and PRMan's spellings.
const std::vector<WarningGroup>& warning_groups();
/// Warnings that are off unless asked for.
const std::vector<std::string_view>& warnings_off_by_default();
/// The warnings `name` stands for: itself or a group's members; empty when there is no such warning.
std::vector<std::string_view> warnings_named(std::string_view name);

/// Reports message `id` with its arguments filled in; notes can be attached to the result until the next
/// report.
template <class... Args>
slvm::Diagnostic& report(slvm::Diagnostics& diags, Msg id, slvm::SourceRange where, const Args&... args) {
  const MessageInfo& info = message_info(id);
  std::string text = fmt::format(fmt::runtime(info.text), args...);
  if (info.severity == slvm::Severity::kError) return diags.error(where, std::move(text));
  return diags.warning(where, info.warning_name, std::move(text));
}

} // namespace slc
