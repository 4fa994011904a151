// docs/shadeops.md: the reference of built-in functions and variables, from the tables of slvm/format.
#include "docs/pages.h"
#include "slvm/format/program.h"

#include <fmt/format.h>
#include <map>
#include <set>
#include <vector>

namespace docs {
namespace {

using namespace slvm;

/// "float(float x, @texture)" of "f" as "float f(float x, ...)", as one writes it.
std::string declaration(const ShadeopInfo& row) {
  std::string text(row.signature_text);
  size_t open = text.find('(');
  text = text.substr(0, open) + " " + std::string(row.name) + text.substr(open);
  for (size_t at = text.find(", @"); at != text.npos; at = text.find(", @"))
    text.replace(at, text.find(')', at) - at, ", ...");
  if (size_t at = text.find("(@"); at != text.npos) text.replace(at + 1, text.find(')', at) - at - 1, "...");
  // The channel of texture functions is written in brackets behind the name.
  if (size_t at = text.find("uniform float channel, "); at != text.npos) text.erase(at, 23);
  return text;
}

std::string function_section(std::string_view name) {
  std::string out = fmt::format("### {}\n\n", name);
  std::map<std::string_view, std::vector<std::string>> by_doc;
  std::vector<std::string_view> order;
  std::set<std::string_view> token_sets;
  bool pending = false;
  for (ShadeopId id : shadeop_overloads(name)) {
    const ShadeopInfo& row = shadeop(id);
    if (row.flags & kInternal) continue;
    if (!by_doc.contains(row.doc)) order.push_back(row.doc);
    by_doc[row.doc].push_back(declaration(row));
    if (!row.signature.token_set.empty()) token_sets.insert(row.signature.token_set);
    pending |= row.kind == ShadeopKind::kPending;
  }
  for (std::string_view doc : order) {
    for (const std::string& d : by_doc[doc])
      out += fmt::format("    {}\n", d);
    out += fmt::format("\n{}.\n\n", escape(doc));
  }
  if (pending)
    out += "*Compiles; binding a shader that calls it is an error, because this version cannot carry it "
           "out.*\n\n";
  for (std::string_view set : token_sets) {
    out += "| token | value | |\n|---|---|---|\n";
    for (const TokenInfo& t : tokens())
      if (t.set == set)
        out +=
            fmt::format("| `\"{}\"` | {}{}{} | {} |\n", t.name, t.output ? "output " : "",
                        t.uniform ? "uniform " : "", t.any ? "any type" : type_name(t.type), escape(t.doc));
    out += '\n';
  }
  return out;
}

} // namespace

std::string shadeops_page() {
  std::string out = std::string("# Built-in functions and variables\n\n") + kGenerated;
  out += "A function with several declarations is chosen by its arguments and by the type that is wanted. "
         "`uniform`\n"
         "parameters need a value that is the same at all points; `...` stands for any number of arguments "
         "of that kind,\n"
         "or for the token-value pairs in the table below the function.\n\n## Variables\n\n"
         "For each kind of shader: r readable, w writable, - not visible.\n\n"
         "| variable | type | surface | displacement | light | volume | imager | "
         "|\n|---|---|---|---|---|---|---|---|\n";
  for (int i = 0; i < kGlobalCount; ++i) {
    const GlobalInfo& g = global_info(static_cast<Global>(i));
    out += fmt::format("| `{}` | {}{} |", g.name, g.detail == Detail::kVarying ? "varying " : "uniform ",
                       type_name(g.type));
    for (char access : g.access)
      out += fmt::format(" {} |", access);
    out += fmt::format(" {} |\n", escape(g.doc));
  }
  out += "\n## Functions\n\n";
  std::set<std::string_view> names;
  for (const ShadeopInfo& row : shadeops())
    if (!(row.flags & kInternal)) names.insert(row.name);
  for (std::string_view name : names)
    out += function_section(name);
  out.pop_back();
  return out;
}

} // namespace docs
