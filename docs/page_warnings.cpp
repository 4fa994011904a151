// docs/warnings.md: what each warning means, from the tables of slc/diag.
#include "docs/pages.h"
#include "slc/diag/messages.h"

#include <algorithm>
#include <fmt/format.h>

namespace docs {
namespace {

using slc::WarningGroup;
using slc::WarningInfo;

std::string in_code(std::string_view program) {
  return fmt::format("```rsl\n{}```\n", program);
}

// The texts that carry a name; {} stands for what the program says there.
std::string texts_of(std::string_view warning) {
  std::string out;
  for (int i = 0; i < static_cast<int>(slc::Msg::kCount); ++i) {
    const slc::MessageInfo& info = slc::message_info(static_cast<slc::Msg>(i));
    if (info.warning_name == warning) out += fmt::format("    warning: {} [-W{}]\n", info.text, warning);
  }
  return out;
}

std::string groups_table() {
  std::string out = "| group | stands for | |\n|---|---|---|\n";
  for (const WarningGroup& group : slc::warning_groups()) {
    std::string members;
    if (group.members.size() == slc::warnings().size())
      members = "all";
    else
      for (std::string_view m : group.members)
        members += fmt::format("{}[{}](#{})", members.empty() ? "" : ", ", m, m);
    out += fmt::format("| `{}` | {} | {} |\n", group.name, members, escape(group.meaning));
  }
  return out + "\n";
}

} // namespace

std::string warnings_page() {
  std::string out = std::string("# Warnings of slc\n\n") + kGenerated;
  out +=
      "A warning says that a program compiles and may all the same not do what was meant, here or with other "
      "compilers.\n"
      "It ends with its name: `[-Wunused]`.\n\n"
      "| | |\n|---|---|\n"
      "| `-Wno-NAME` | silences it |\n"
      "| `-WNAME` | asks for one that is off by default, or for a group |\n"
      "| `-Werror` | makes errors of all warnings: the file is not compiled |\n"
      "| `-nw` | no warnings at all |\n"
      "| `#pragma nolint` | on a line of its own: no warnings about the statement that follows |\n"
      "| `slc --explain NAME` | prints what stands below; `all` lists the names |\n\n"
      "Later options win over earlier ones: `-Wall -Wno-unused` leaves one out. `SLC_OPTIONS` in the "
      "environment "
      "comes first.\n\n";
  out += groups_table();
  out += "| warning | by default | |\n|---|---|---|\n";
  for (const WarningInfo& w : slc::warnings())
    out += fmt::format("| [{0}](#{0}) | {1} | {2} |\n", w.name, w.on ? "on" : "off", escape(w.meaning));
  for (const WarningInfo& w : slc::warnings()) {
    out += fmt::format("\n## {}\n\n{}\n{}\n{}\n", w.name, paragraph(escape(w.meaning)),
                       paragraph(escape(w.reason)), texts_of(w.name));
    out += in_code(w.example) + "\nInstead:\n\n" + in_code(w.mended);
    out += "\n" + paragraph(escape(w.remedy));
  }
  return out;
}

} // namespace docs
