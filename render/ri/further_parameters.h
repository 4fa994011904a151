// Parameters of options, attributes and requests beyond those of render/rib/parameters.def, with their types:
// a C program hands over a pointer and no length, so that types must be known where a RIB file can do
// without.
#pragma once

#include <span>
#include <string_view>

namespace render::ri {

struct FurtherParameter {
  std::string_view category; ///< "Option limits", "Attribute trace" or a request: "Display"
  std::string_view name;
  std::string_view declaration; ///< as for RiDeclare
};

std::span<const FurtherParameter> further_parameters();

} // namespace render::ri
