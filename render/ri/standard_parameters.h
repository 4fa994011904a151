// The parameters that options, attributes and requests are known to take, with their types: a C program hands
// over a pointer and no length, so that their types must be known where a RIB file can do without.
#pragma once

#include <span>
#include <string_view>

namespace render::ri {

struct StandardParameter {
  std::string_view category; ///< "Option limits", "Attribute trace" or a request: "Display"
  std::string_view name;
  std::string_view declaration; ///< as for RiDeclare
};

std::span<const StandardParameter> standard_parameters();

} // namespace render::ri
