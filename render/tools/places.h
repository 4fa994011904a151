// Where the shaders and headers that come with Anemone are, beside the program as installed or as built.
#pragma once

#include <string>
#include <vector>

namespace render::tools {

/// Folders with the standard shaders, compiled or as sources; may be empty.
std::vector<std::string> standard_shader_folders();
/// Folder of the standard RSL headers; "" if there is none.
std::string standard_include_folder();

} // namespace render::tools
