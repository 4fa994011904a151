// Named values of options, attributes, hiders and displays: checks of their types, and the messages of those
// that have no effect.
#include "render/rib/parameters.h"
#include "render/state/interpreter.h"
#include "render/state/state_values.h"

#include <fmt/format.h>

#include <algorithm>

namespace render {

namespace {

std::string wanted(const ParameterInfo& info) {
  size_t width = info.width().value_or(1);
  if (width == 0) return "one string";
  return width == 1 ? "one number" : fmt::format("{} numbers", width);
}

bool fits(const ParameterInfo& info, const slvm::Value& value) {
  auto width = info.width();
  if (!width) return true;
  if (*width == 0) return value.strings.size() == 1;
  return value.numbers.size() == *width || (info.type == "color" && value.numbers.size() == 1);
}

/// `Attribute "dice" "hair"`, `Hider "jitter"`.
std::string title(std::string_view request, std::string_view category, std::string_view name) {
  std::string out(request);
  for (std::string_view word : {category, name})
    if (!word.empty()) out += fmt::format(" \"{}\"", word);
  return out;
}

std::string near_or_known(std::string_view name, const std::vector<std::string_view>& names) {
  std::string_view near = slvm::nearest_name(name, names);
  if (!near.empty()) return fmt::format("; did you mean \"{}\"?", near);
  return names.empty() ? "" : fmt::format("; known are {}", fmt::join(names, ", "));
}

} // namespace

std::optional<std::pair<std::string, slvm::Value>>
Interpreter::named_value_of(const RequestCall& call, std::string_view category, const Param& p) {
  ParameterPlace place{call.id, category, p.where};
  if (call.id == RequestId::kOption && category == "hider") place = {RequestId::kHider, "hidden", p.where};
  auto value = loose_value(p, declarations_);
  // "enable gaussian" is a name with a blank, not a declaration.
  const ParameterInfo* spaced = value ? nullptr : find_parameter(place.table, place.category, p.token);
  if (spaced && spaced->name == p.token) {
    Param plain = p;
    plain.token = "value";
    value = loose_value(plain, declarations_);
    if (value) value->first = p.token;
  }
  if (!value) {
    error_at(p.where, call, value.error());
    return {};
  }
  if (!check_parameter(call, place, value->first, value->second)) return {};
  return *value;
}

bool Interpreter::check_parameter(const RequestCall& call, const ParameterPlace& place,
                                  const std::string& name, const slvm::Value& value) {
  const ParameterInfo* info = find_parameter(place.table, place.category, name);
  if (!info) {
    unknown_parameter(place, name);
    return true;
  }
  if (!fits(*info, value)) {
    error_at(place.where, call, fmt::format("\"{}\" takes {}", name, wanted(*info)));
    return false;
  }
  if (info->lacks.empty() || (!info->standard.empty() && text_of(value) == info->standard)) return true;
  std::string what =
      title(request_info(place.table).name, info->category, info->name == "*" ? "" : info->name);
  warn_once(what, place.where, "rib-unsupported", fmt::format("{} has no effect: {}", what, info->lacks));
  return true;
}

void Interpreter::no_parameters(const RequestCall& call) {
  for (const Param& p : call.params)
    no_parameter(call, p);
}

void Interpreter::no_parameter(const RequestCall& call, const Param& p) {
  std::string what = title(call.info().name, "", p.token);
  warn_once(what, p.where, "rib-unsupported", fmt::format("{} is not known and has no effect", what));
}

void Interpreter::unknown_parameter(const ParameterPlace& place, const std::string& name) {
  if (place.table == RequestId::kDisplay) {
    // "tiff:planarconfig": its writer knows what for.
    if (name.find(':') == std::string::npos)
      warn_once("Display " + name, place.where, "rib-unsupported",
                fmt::format("Display \"{}\" is not known here and is left to the file format{}", name,
                            near_or_known(name, parameter_names(place.table, ""))));
    return;
  }
  bool readable = place.table == RequestId::kOption || place.table == RequestId::kAttribute;
  auto categories = parameter_categories(place.table);
  bool known =
      !readable || std::find(categories.begin(), categories.end(), place.category) != categories.end();
  std::string what = title(request_info(place.table).name, readable ? place.category : std::string_view(),
                           known ? std::string_view(name) : std::string_view());
  warn_once(what, place.where, "rib-unsupported",
            fmt::format("{} is not known and has no effect{}{}", what,
                        readable ? " (shaders can read its value)" : "",
                        known ? near_or_known(name, parameter_names(place.table, place.category))
                              : near_or_known(place.category, categories)));
}

} // namespace render
