// Where things are: the shaders that come with Anemone, and search paths from the environment.
#pragma once

#include <string>
#include <vector>

namespace render::setup {

/// Folders with the standard shaders, compiled or as sources; may be empty. They are beside the program, as
/// installed or as built, or where Anemone was configured to be installed.
std::vector<std::string> standard_shader_folders();

/// A search path: the current folder and `installed`, unless the environment variable, and then the user's
/// `option`, say otherwise.
std::vector<std::string> search_path(const std::string& option, const char* variable,
                                     const std::vector<std::string>& installed);

/// The folders plug-ins may come from: the same path if the user gave one, else none.
std::vector<std::string> procedural_folders(const std::string& option, const char* variable);

} // namespace render::setup
