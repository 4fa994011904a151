// Look-up in the table of parameters.def.
#include "render/rib/parameters.h"

#include <algorithm>

namespace render {

namespace {

constexpr ParameterInfo kParameters[] = {
#define PARAMETER(request, category, name, type, standard, lacks, doc)                                       \
  {RequestId::k##request, category, name, type, standard, lacks, doc},
#include "render/rib/parameters.def"
#undef PARAMETER
};

const ParameterInfo* find_exactly(RequestId request, std::string_view category, std::string_view name) {
  for (const ParameterInfo& p : kParameters)
    if (p.request == request && p.category == category && p.name == name) return &p;
  return nullptr;
}

} // namespace

std::optional<size_t> ParameterInfo::width() const {
  if (type == "any") return {};
  if (type == "string") return 0;
  if (type == "color") return 3;
  if (size_t bracket = type.find('['); bracket != std::string_view::npos)
    return static_cast<size_t>(type[bracket + 1] - '0'); // a digit, in all rows
  return 1;
}

std::span<const ParameterInfo> parameters() {
  return kParameters;
}

const ParameterInfo* find_parameter(RequestId request, std::string_view category, std::string_view name) {
  if (const ParameterInfo* p = find_exactly(request, category, name)) return p;
  if (request == RequestId::kHider) return find_exactly(request, "", name);
  return find_exactly(request, category, "*");
}

std::vector<std::string_view> parameter_categories(RequestId request) {
  std::vector<std::string_view> out;
  for (const ParameterInfo& p : kParameters)
    if (p.request == request && std::find(out.begin(), out.end(), p.category) == out.end())
      out.push_back(p.category);
  return out;
}

std::vector<std::string_view> parameter_names(RequestId request, std::string_view category) {
  std::vector<std::string_view> out;
  for (const ParameterInfo& p : kParameters)
    if (p.request == request && p.name != "*" &&
        (p.category == category || (request == RequestId::kHider && p.category.empty())))
      out.push_back(p.name);
  return out;
}

} // namespace render
