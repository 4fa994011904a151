// The compiler's messages by name, and how to report one. The texts are in messages.def, what the warnings
// mean in warnings.def.
#pragma once

#include "slvm/support/diagnostics.h"

#include <fmt/format.h>
#include <span>
#include <string>
#include <vector>

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

/// What one warning is about, for manual and --explain.
struct WarningInfo {
  std::string_view name;
  bool on; ///< unless switched off
  std::string_view meaning, reason;
  std::string_view example, mended; ///< programs: with the warning, and without
  std::string_view remedy;
};
/// By name.
std::span<const WarningInfo> warnings();

/// A name for several warnings, usable wherever the name of one is.
struct WarningGroup {
  std::string_view name;
  std::vector<std::string_view> members;
  std::string_view meaning;
};
/// "all", "lint" and "strict".
const std::vector<WarningGroup>& warning_groups();
/// What `slc --explain NAME` prints about a warning or a group; empty when there is none of that name.
std::string explain_warning(std::string_view name);
/// The warnings `name` stands for: itself or a group's members; empty when there is no such warning.
std::vector<std::string_view> warnings_named(std::string_view name);

/// "1 argument", "2 arguments".
inline std::string counted(size_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

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
