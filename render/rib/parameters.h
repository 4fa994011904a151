// The named values of Option, Attribute, Hider, Display, DisplayChannel and GeometricApproximation as data,
// from parameters.def.
#pragma once

#include "render/rib/request.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace render {

struct ParameterInfo {
  RequestId request;
  std::string_view category; ///< first argument of Option and Attribute, type of Hider
  std::string_view name;     ///< "*": any
  std::string_view type;
  std::string_view standard; ///< what is done without it, as text; empty: nothing to compare with
  std::string_view lacks;    ///< why it has no effect; empty when it is carried out
  std::string_view doc;

  /// Numbers a value has; 0 for strings. None: any value will do. Colours may be one number.
  std::optional<size_t> width() const;
};

std::span<const ParameterInfo> parameters();
/// The row of this name, else that of all names of the category, else nullptr. What all hiders have is found
/// under each.
const ParameterInfo* find_parameter(RequestId, std::string_view category, std::string_view name);
/// For messages: the categories of a request, and the names of a category.
std::vector<std::string_view> parameter_categories(RequestId);
std::vector<std::string_view> parameter_names(RequestId, std::string_view category);

} // namespace render
