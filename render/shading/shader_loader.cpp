// The default shader loader.
#include "render/shading/shader_loader.h"

#include "render/state/search_path.h"

#include <fmt/format.h>

namespace render {

slvm::Error no_such_shader(const std::string& name, const std::vector<std::string>& path) {
  return {fmt::format("no shader \"{}\" in the search path \"{}\"", name, fmt::join(path, ":"))};
}

slvm::Result<std::string> load_compiled_shader(const std::string& name,
                                               const std::vector<std::string>& path) {
  auto found = find_file(name.ends_with(".slo") ? name : name + ".slo", path);
  if (!found) return no_such_shader(name, path);
  auto bytes = read_file(*found);
  if (!bytes) return slvm::Error{fmt::format("cannot read \"{}\"", *found)};
  return std::move(*bytes);
}

} // namespace render
