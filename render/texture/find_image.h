// Where an image is that a scene names: as it stands, in the search path, or under a name it got later.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// Tries the name in the folders; then, for names of files that were never made or stood on another machine,
/// other extensions (wood.tx as wood.tif) and the name without its folders.
std::optional<std::string> find_image(std::string_view name, const std::vector<std::string>& folders);

} // namespace render
