// Writes the pages of docs/ that are lists: shadeops.md, instructions.md, requests.md, warnings.md, from the
// tables which are the only place where functions, tokens, variables, instructions, RIB requests and compiler
// messages are listed. Usage: generate_tables FOLDER
#include "docs/pages.h"
#include "slvm/format/program.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>

namespace {

using namespace slvm;
using docs::escape;
using docs::kGenerated;

std::string instructions_page() {
  std::string out = std::string("# Instructions\n\n") + kGenerated;
  out += "An instruction is one 32-bit word, opcode in the low half and number of operand words in the high "
         "half, and its\n"
         "operand words. A register operand has the space in its top three bits (constant, uniform, strip, "
         "grid, slot,\n"
         "array) and the index of the first plane below. Opcodes from 64 on call imported shadeops: stored "
         "operands first,\n"
         "then read ones.\n\nOperands: `d` stored to, `s` read, `b` read and a bool, `a` array, `t` jump "
         "target, `n` number,\n"
         "`p` number of planes. Flags: *grid* (never inside a strip block), *open*, *middle*, *close* "
         "(brackets of a region),\n"
         "*loops* (break and continue count it).\n\n| opcode | name | operands | flags | "
         "|\n|---|---|---|---|---|\n";
  for (int i = 0; i < static_cast<int>(Opcode::kCount); ++i) {
    const OpcodeInfo& info = opcode_info(static_cast<Opcode>(i));
    std::string flags;
    constexpr std::pair<uint8_t, const char*> kNames[] = {
        {kGridOnly, "grid"}, {kOpen, "open"}, {kMiddle, "middle"}, {kClose, "close"}, {kLoops, "loops"}};
    for (auto [bit, name] : kNames)
      if (info.flags & bit) flags += (flags.empty() ? "" : ", ") + std::string(name);
    out += fmt::format("| {} | `{}` | {} | {} | {} |\n", i, info.name, info.operands, flags,
                       escape(info.synopsis));
  }
  return out;
}

std::string parameters_section() {
  struct Parameter {
    std::string_view request, category, name, type, standard, lacks, doc;
  };
  constexpr Parameter kParameters[] = {
#define PARAMETER(request, category, name, type, standard, lacks, doc)                                       \
  {#request, category, name, type, standard, lacks, doc},
#include "render/rib/parameters.def"
#undef PARAMETER
  };
  std::string out =
      "\n## Named values\n\n"
      "Of `Option`, `Attribute`, `Hider`, `Display`, `DisplayChannel` and `GeometricApproximation`. What "
      "has no effect is said\n"
      "once, with the reason, unless it is set to what is done anyway (the default). Shaders can read "
      "all values of options\n"
      "and attributes.\n\n| name | type | default | |\n|---|---|---|---|\n";
  for (const Parameter& p : kParameters) {
    std::string category = p.category.empty() ? "" : fmt::format(" \"{}\"", p.category);
    std::string name = p.name == "*" ? "" : fmt::format(" \"{}\"", p.name);
    std::string text(p.doc);
    if (!p.lacks.empty()) text += fmt::format("{}no effect: {}", text.empty() ? "" : "; ", p.lacks);
    out += fmt::format("| `{}{}{}` | {} | {} | {} |\n", p.request, category, name, p.type, p.standard,
                       escape(text));
  }
  return out;
}

std::string requests_page() {
  struct Request {
    std::string_view name, arguments, where, lacks, doc;
  };
  constexpr Request kRequests[] = {
#define REQUEST(name, arguments, where, lacks, doc) {#name, arguments, where, lacks, doc},
#include "render/rib/requests.def"
#undef REQUEST
  };
  std::string out = std::string("# RIB requests\n\n") + kGenerated;
  out += "Every request of the RenderMan interface is parsed. A request of the second table is not, or not "
         "wholly, carried\n"
         "out by this version; `slrender` says so once for each when a scene uses it.\n\n"
         "## Carried out\n\n| request | arguments | |\n|---|---|---|\n";
  std::string lacking = "\n## Parsed, with something lacking\n\n| request | then | |\n|---|---|---|\n";
  for (const Request& r : kRequests) {
    if (r.lacks.empty())
      out += fmt::format("| `{}` | {} | {} |\n", r.name, escape(r.arguments), escape(r.doc));
    else
      lacking += fmt::format("| `{}` | {} | {} |\n", r.name, escape(r.lacks), escape(r.doc));
  }
  return out + lacking + parameters_section();
}

bool write(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  return static_cast<bool>(out.flush());
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: generate_tables FOLDER\n", stderr);
    return 2;
  }
  std::string folder = argv[1];
  bool ok = write(folder + "/shadeops.md", docs::shadeops_page()) &&
            write(folder + "/instructions.md", instructions_page()) &&
            write(folder + "/requests.md", requests_page()) &&
            write(folder + "/warnings.md", docs::warnings_page());
  if (!ok) {
    std::fputs("error: cannot write the pages\n", stderr);
    return 3;
  }
  return 0;
}
