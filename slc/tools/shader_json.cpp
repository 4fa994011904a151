#include "slc/tools/shader_json.h"

#include "slvm/format/disasm.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace slc {
namespace {

using Json = nlohmann::ordered_json;
using slvm::Param;
using slvm::Program;

constexpr int kSchemaVersion = 1;

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

Json places_as_json(const Inspected& shader, const std::vector<SourceRange>& places) {
  Json json = Json::array();
  for (const SourceRange& p : places)
    json.push_back({{"file", shader.file_name(p.file)}, {"line", p.line}, {"column", p.column}});
  return json;
}

Json uses_as_json(const Inspected& shader, const std::vector<Use>& list) {
  constexpr std::string_view kKinds[] = {"nothing", "constant", "parameter", "computed"};
  Json json = Json::array();
  for (const Use& use : list) {
    bool has_text = use.name.kind == Naming::kConstant || use.name.kind == Naming::kParameter;
    json.push_back({{"by", use.by},
                    {"name", has_text ? Json(use.name.text) : Json(nullptr)},
                    {"named_by", kKinds[use.name.kind]},
                    {"places", places_as_json(shader, use.places)}});
  }
  return json;
}

Json calls_as_json(const Inspected& shader) {
  Json json = Json::array();
  for (const CallUse& use : shader.uses.calls) {
    const slvm::ShadeopInfo& info = use.info();
    json.push_back({{"name", info.name},
                    {"signature", info.signature_text},
                    {"plugin", use.plugin ? Json(use.plugin->name().library) : Json(nullptr)},
                    {"count", use.places.size()},
                    {"places", places_as_json(shader, use.places)}});
  }
  return json;
}

void add_parameters(Json& json, const Program& program, const std::string& only) {
  json["parameters"] = Json::array();
  for (const Param& p : program.params)
    if (only.empty() || p.name == only) json["parameters"].push_back(param_as_json(p));
  json["annotations"] = Json::array();
  for (const slvm::Annotation& a : program.annotations)
    json["annotations"].push_back({{"id", a.id}, {"text", a.text}});
}

void add_messages(Json& json, const Inspected& shader) {
  json["messages_read"] = shader.program.facts.messages_read;
  Json outputs = Json::array();
  for (const Param& p : shader.program.params)
    if (p.output) outputs.push_back(p.name);
  json["messages"] = {{"reads", uses_as_json(shader, shader.uses.messages)},
                      {"sends", uses_as_json(shader, shader.uses.sent)},
                      {"outputs", outputs}};
}

void add_uses(Json& json, const Inspected& shader) {
  const slvm::Facts& facts = shader.program.facts;
  const Uses& uses = shader.uses;
  json["uses"] = {{"derivatives", facts.derivatives},
                  {"lights", facts.lights},
                  {"textures", facts.textures},
                  {"rays", facts.rays}};
  json["shadeops"] = facts.shadeops;
  json["texture_names"] = facts.texture_names;
  json["plugins"] = facts.plugins;
  json["calls"] = calls_as_json(shader);
  json["textures"] = uses_as_json(shader, uses.textures);
  json["rays"] = uses_as_json(shader, uses.rays);
  json["lights"] = uses_as_json(shader, uses.lights);
  json["derivatives"] = uses_as_json(shader, uses.derivatives);
  json["queries"] = uses_as_json(shader, uses.queries);
  json["spaces"] = uses_as_json(shader, uses.spaces);
  json["variables"] = {{"read", uses.read}, {"written", uses.written}};
}

void add_sources(Json& json, const Inspected& shader) {
  const Program& p = shader.program;
  json["compiler"] = p.compiler.empty() ? Json(nullptr) : Json(p.compiler);
  json["sources"] = Json::array();
  std::vector<slvm::SourceCheck> checks = slvm::check_sources(p, shader.path);
  for (size_t i = 0; i < checks.size(); ++i)
    json["sources"].push_back({{"name", checks[i].name},
                               {"hash", fmt::format("{:016x}", p.sources[i].hash)},
                               {"state", state_name(checks[i].state)}});
}

void add_source_map(Json& json, const Inspected& shader) {
  const Program& p = shader.program;
  const SourceLines lines(p, shader.path);
  Json& map = json["source_map"] = Json::array();
  for (size_t i = 0; i < p.lines.size(); ++i) {
    const slvm::LineEntry& entry = p.lines[i];
    size_t end = i + 1 < p.lines.size() ? p.lines[i + 1].code : p.code.size();
    const std::string text = lines.text(entry.file, entry.line);
    map.push_back({{"begin", entry.code},
                   {"end", end},
                   {"file", shader.file_name(entry.file)},
                   {"line", entry.line},
                   {"column", entry.column},
                   {"text", text.empty() ? Json(nullptr) : Json(text)}});
  }
}

void add_disassembly(Json& json, const Inspected& shader) {
  const SourceLines lines(shader.program, shader.path);
  json["disassembly"] =
      slvm::disassemble(shader.program, [&](uint32_t file, uint32_t line) { return lines.text(file, line); });
}

Json shader_as_json(const Inspected& shader, const std::string& only, const Listings& listings) {
  const Program& program = shader.program;
  const bool all = !listings.any();
  Json json;
  json["kind"] = slvm::shader_kind_name(program.kind);
  json["name"] = program.name;
  json["source"] = program.source_name;
  json["source_hash"] = fmt::format("{:016x}", program.source_hash);
  if (all) add_parameters(json, program, only);
  if (all || listings.uses) add_uses(json, shader);
  if (all || listings.messages) add_messages(json, shader);
  if (all || listings.sources) add_sources(json, shader);
  if (listings.source_map) add_source_map(json, shader);
  if (listings.disassembly) add_disassembly(json, shader);
  return json;
}

} // namespace

std::string shaders_as_json(std::span<const Inspected> shaders, const std::string& only,
                            const Listings& listings) {
  Json json;
  json["schema"] = "anemone-sloinfo";
  json["version"] = kSchemaVersion;
  json["shaders"] = Json::array();
  for (const Inspected& shader : shaders)
    json["shaders"].push_back(shader_as_json(shader, only, listings));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace slc
