// Options and attributes by name, as option() and attribute() of the shading language, conditions and
// substitutions in RIB ask for them: "Shutter", "Ri:Shutter", "user:pass", "limits:gridsize".
#pragma once

#include "render/state/attributes.h"
#include "render/state/options.h"

#include <optional>
#include <string>
#include <string_view>

namespace render {

std::optional<slvm::Value> option_value(const Options&, std::string_view name);
std::optional<slvm::Value> attribute_value(const Attributes&, std::string_view name);

/// A value as text: numbers as %g, several of them with blanks between.
std::string text_of(const slvm::Value&);

} // namespace render
