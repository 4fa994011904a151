#include "slc/tools/shader_description.h"

#include "slvm/format/disasm.h"

#include <fmt/format.h>

namespace slc {
namespace {

using slvm::Param;
using slvm::Program;
using slvm::Type;

std::string type_text(const Param& p) {
  std::string text(slvm::type_name(p.type));
  return p.elements ? fmt::format("{}[{}]", text, p.elements) : text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

} // namespace

std::string declaration(const Param& p) {
  return fmt::format("{}parameter {} {}", p.output ? "output " : "", p.varying ? "varying" : "uniform",
                     type_text(p));
}

std::string in_quotes(std::string_view text) {
  std::string result(1, '"');
  for (char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (c == '\r')
      result += "\\r";
    else
      result += c;
  }
  result += '"';
  return result;
}

std::string space_of(const Param& p) {
  if (p.type == Type::kFloat || p.type == Type::kString) return "";
  if (!p.default_space.empty()) return p.default_space;
  return p.type == Type::kColor ? "rgb" : "current";
}

std::string default_text(const Param& p) {
  if (!p.default_known) return "[unknown]";
  const slvm::Value& value = p.default_value;
  std::string list;
  for (float x : value.numbers)
    list += fmt::format("{}{:g}", list.empty() ? "" : " ", x);
  for (const std::string& s : value.strings)
    list += fmt::format("{}{}", list.empty() ? "" : " ", in_quotes(s));
  if (!p.elements && (p.type == Type::kFloat || p.type == Type::kString)) return list;
  std::string space = space_of(p);
  return space.empty() ? fmt::format("[{}]", list) : fmt::format("{} [{}]", in_quotes(space), list);
}

std::string shader_as_text(const Program& program, const std::string& only) {
  std::string text = heading(program);
  for (const Param& p : program.params)
    if (only.empty() || p.name == only)
      text += fmt::format("    {} {}\n\t\tDefault value: {}\n", in_quotes(p.name), in_quotes(declaration(p)),
                          default_text(p));
  return text;
}

std::string heading(const Program& program) {
  return fmt::format("{} {}\n", slvm::shader_kind_name(program.kind), in_quotes(program.name));
}

std::string listings_as_text(const Inspected& shader, const Listings& listings) {
  // The listing of the code has a heading of its own.
  Listings others = listings;
  others.disassembly = false;
  std::string text = others.any() ? heading(shader.program) : "";
  if (listings.messages) text += messages_as_text(shader);
  if (listings.uses) text += uses_as_text(shader);
  if (listings.sources) text += sources_as_text(shader);
  if (listings.source_map) text += source_map_as_text(shader);
  if (listings.disassembly) {
    const SourceLines lines(shader.program, shader.path);
    text += slvm::disassemble(shader.program,
                              [&](uint32_t file, uint32_t line) { return lines.text(file, line); });
  }
  return text;
}

std::string plugins_as_text(const Program& program) {
  std::string text;
  for (const std::string& plugin : program.facts.plugins)
    text += plugin + '\n';
  return text;
}

std::string annotations_as_xml(const Program& program) {
  std::string text = fmt::format("<shader name=\"{}\">\n", escaped(program.name));
  for (const slvm::Annotation& a : program.annotations)
    text += fmt::format("  <meta id=\"{}\">{}</meta>\n", escaped(a.id), escaped(a.text));
  return text + "</shader>\n";
}

} // namespace slc
