// Descriptions of compiled shaders as text: the layout that scripts of the field parse, and listings of what
// a shader uses and of its code. JSON: shader_json.h.
#pragma once

#include "slc/tools/inspected.h"

#include <string>
#include <string_view>

namespace slc {

/// Kind and name, then each parameter with its declaration and default:
///
///   surface "plastic"
///       "Ka" "parameter uniform float"
///   <tab><tab>Default value: 1
///
/// Only the parameter `only`, if it is not empty.
std::string shader_as_text(const slvm::Program& program, const std::string& only);

/// Plug-ins called, one path a line.
std::string plugins_as_text(const slvm::Program& program);

/// `<shader name="..."><meta id="...">...</meta></shader>`.
std::string annotations_as_xml(const slvm::Program& program);

/// What --messages, --uses and the others ask for instead of the parameters.
struct Listings {
  bool messages = false, uses = false, sources = false, source_map = false, disassembly = false;
  bool any() const { return messages || uses || sources || source_map || disassembly; }
};

/// Kind and name, then the listings asked for.
std::string listings_as_text(const Inspected& shader, const Listings& listings);

// Parts of these, which have a file each.
std::string messages_as_text(const Inspected& shader);
std::string uses_as_text(const Inspected& shader);
std::string sources_as_text(const Inspected& shader);
std::string source_map_as_text(const Inspected& shader);

/// `surface "plastic"` and a line end.
std::string heading(const slvm::Program& program);
/// A string as the language writes it.
std::string in_quotes(std::string_view text);
/// "output parameter varying color[2]".
std::string declaration(const slvm::Param& param);
/// The default as the language writes it, with its space; "[unknown]" when it is not a constant.
std::string default_text(const slvm::Param& param);
/// The space a default is given in; "" for types without one.
std::string space_of(const slvm::Param& param);
/// "unchanged", "changed" or "not found".
std::string_view state_name(slvm::SourceState state);

} // namespace slc
