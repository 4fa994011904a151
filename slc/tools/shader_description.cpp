#include "slc/tools/shader_description.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace slc {
namespace {

using Json = nlohmann::ordered_json;
using slvm::Param;
using slvm::Program;
using slvm::Type;

constexpr int kSchemaVersion = 1;

std::string type_text(const Param& p) {
  std::string text(slvm::type_name(p.type));
  return p.elements ? fmt::format("{}[{}]", text, p.elements) : text;
}

std::string declaration(const Param& p) {
  return fmt::format("{}parameter {} {}", p.output ? "output " : "", p.varying ? "varying" : "uniform",
                     type_text(p));
}

/// A string as the language writes it.
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

/// The space a default is given in; "" for types without one.
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

/// The double that is written like the float: 0.1, not 0.10000000149011612. JSON has no infinities and NaNs.
Json number(float x) {
  if (!std::isfinite(x)) return fmt::format("{}", x);
  return std::stod(fmt::format("{}", x));
}

Json default_as_json(const Param& p) {
  if (!p.default_known) return nullptr;
  Json values = Json::array();
  for (float x : p.default_value.numbers)
    values.push_back(number(x));
  for (const std::string& s : p.default_value.strings)
    values.push_back(s);
  return !p.elements && values.size() == 1 ? values[0] : values;
}

Json param_as_json(const Param& p) {
  Json json;
  json["name"] = p.name;
  json["type"] = slvm::type_name(p.type);
  json["array_length"] = p.elements ? Json(p.elements) : Json(nullptr);
  json["detail"] = p.varying ? "varying" : "uniform";
  json["output"] = p.output;
  json["default"] = default_as_json(p);
  json["default_space"] = p.default_known && !space_of(p).empty() ? Json(space_of(p)) : Json(nullptr);
  return json;
}

Json shader_as_json(const Program& program, const std::string& only) {
  Json json;
  json["kind"] = slvm::shader_kind_name(program.kind);
  json["name"] = program.name;
  json["source"] = program.source_name;
  json["source_hash"] = fmt::format("{:016x}", program.source_hash);
  json["parameters"] = Json::array();
  for (const Param& p : program.params)
    if (only.empty() || p.name == only) json["parameters"].push_back(param_as_json(p));
  json["annotations"] = Json::array();
  for (const slvm::Annotation& a : program.annotations)
    json["annotations"].push_back({{"id", a.id}, {"text", a.text}});
  const slvm::Facts& facts = program.facts;
  json["uses"] = {{"derivatives", facts.derivatives},
                  {"lights", facts.lights},
                  {"textures", facts.textures},
                  {"rays", facts.rays}};
  json["shadeops"] = facts.shadeops;
  json["texture_names"] = facts.texture_names;
  json["messages_read"] = facts.messages_read;
  json["plugins"] = facts.plugins;
  return json;
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

std::string shader_as_text(const Program& program, const std::string& only) {
  std::string text = fmt::format("{} {}\n", slvm::shader_kind_name(program.kind), in_quotes(program.name));
  for (const Param& p : program.params)
    if (only.empty() || p.name == only)
      text += fmt::format("    {} {}\n\t\tDefault value: {}\n", in_quotes(p.name), in_quotes(declaration(p)),
                          default_text(p));
  return text;
}

std::string shaders_as_json(std::span<const Program> programs, const std::string& only) {
  Json json;
  json["schema"] = "anemone-sloinfo";
  json["version"] = kSchemaVersion;
  json["shaders"] = Json::array();
  for (const Program& program : programs)
    json["shaders"].push_back(shader_as_json(program, only));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
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
