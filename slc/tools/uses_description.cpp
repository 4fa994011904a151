// What a shader uses, as text: sloinfo --messages and --uses.
#include "slc/tools/shader_description.h"

#include <algorithm>
#include <fmt/format.h>

namespace slc {
namespace {

constexpr std::string_view kSection = "    ", kEntry = "        ";

// "wood.sl:3,8 noise.h:2".
std::string places_text(const Inspected& shader, const std::vector<SourceRange>& places) {
  std::string text;
  const SourceRange* last = nullptr;
  for (const SourceRange& p : places) {
    if (last && last->file == p.file && last->line == p.line) continue;
    if (last && last->file == p.file)
      text += fmt::format(",{}", p.line);
    else
      text += fmt::format("{}{}:{}", last ? " " : "", shader.file_name(p.file), p.line);
    last = &p;
  }
  return text;
}

// Behind the function or statement: which thing.
std::string naming_text(const Inspected& shader, const Naming& name, bool all_when_empty) {
  switch (name.kind) {
  case Naming::kNone: return "";
  case Naming::kConstant:
    return all_when_empty && name.text.empty() ? ", all lights" : " " + in_quotes(name.text);
  case Naming::kComputed: return ", a computed name";
  case Naming::kParameter: break;
  }
  const auto& params = shader.program.params;
  auto p =
      std::find_if(params.begin(), params.end(), [&](const slvm::Param& x) { return x.name == name.text; });
  return fmt::format(", parameter {}{}", in_quotes(name.text),
                     p == params.end() ? "" : ", by default " + default_text(*p));
}

std::string section(const Inspected& shader, std::string_view title, const std::vector<Use>& list,
                    bool is_lights = false) {
  if (list.empty()) return "";
  std::string text = fmt::format("{}{}\n", kSection, title);
  for (const Use& use : list)
    text += fmt::format("{}{}{}: {}\n", kEntry, use.by, naming_text(shader, use.name, is_lights),
                        places_text(shader, use.places));
  return text;
}

std::string names(std::string_view title, const std::vector<std::string>& list) {
  return list.empty() ? "" : fmt::format("{}{}\n{}{}\n", kSection, title, kEntry, fmt::join(list, " "));
}

std::string calls_section(const Inspected& shader) {
  const std::vector<CallUse>& calls = shader.uses.calls;
  std::string text = calls.empty() ? "" : fmt::format("{}functions\n", kSection);
  for (const CallUse& use : calls) {
    const slvm::ShadeopInfo& info = use.info();
    size_t count = use.places.size();
    text += fmt::format("{}{} {}{}: {} call{}, {}\n", kEntry, in_quotes(info.name),
                        in_quotes(info.signature_text),
                        use.plugin ? " of the plug-in " + in_quotes(use.plugin->name().library) : "", count,
                        count == 1 ? "" : "s", places_text(shader, use.places));
  }
  return text;
}

} // namespace

std::string messages_as_text(const Inspected& shader) {
  std::string text = section(shader, "messages read", shader.uses.messages);
  if (text.empty()) text = fmt::format("{}no messages read\n", kSection);
  text += section(shader, "messages sent to lights", shader.uses.sent);
  std::string outputs;
  for (const slvm::Param& p : shader.program.params)
    if (p.output) outputs += fmt::format("{}{} {}\n", kEntry, in_quotes(p.name), in_quotes(declaration(p)));
  return text + (outputs.empty() ? fmt::format("{}no outputs\n", kSection)
                                 : fmt::format("{}outputs\n{}", kSection, outputs));
}

std::string uses_as_text(const Inspected& shader) {
  const Uses& uses = shader.uses;
  std::string text = calls_section(shader);
  text += names("plug-ins", shader.program.facts.plugins);
  text += section(shader, "textures", uses.textures);
  text += section(shader, "rays", uses.rays);
  text += section(shader, "lights", uses.lights, true);
  text += section(shader, "derivatives", uses.derivatives);
  text += section(shader, "attributes and options", uses.queries);
  text += section(shader, "coordinate systems", uses.spaces);
  text += names("variables read", uses.read);
  text += names("variables written", uses.written);
  return text;
}

} // namespace slc
