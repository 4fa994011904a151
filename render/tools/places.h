// Where the shaders that come with Anemone are, beside the program as installed or as built.
#pragma once

#include <string>
#include <vector>

namespace render::tools {

/// Folders with the standard shaders, compiled or as sources; may be empty.
std::vector<std::string> standard_shader_folders();

} // namespace render::tools
