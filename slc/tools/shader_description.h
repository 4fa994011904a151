// Descriptions of compiled shaders, as sloinfo prints them: the layout that scripts of the field parse, and
// JSON.
#pragma once

#include "slvm/format/program.h"

#include <span>
#include <string>

namespace slc {

/// Kind and name, then each parameter with its declaration and default:
///
///   surface "plastic"
///       "Ka" "parameter uniform float"
///   <tab><tab>Default value: 1
///
/// Only the parameter `only`, if it is not empty.
std::string shader_as_text(const slvm::Program& program, const std::string& only);

/// The schema of docs/sloinfo-schema.md.
std::string shaders_as_json(std::span<const slvm::Program> programs, const std::string& only);

/// Plug-ins called, one path a line.
std::string plugins_as_text(const slvm::Program& program);

/// `<shader name="..."><meta id="...">...</meta></shader>`.
std::string annotations_as_xml(const slvm::Program& program);

} // namespace slc
