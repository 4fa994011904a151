// Where compiled shaders come from. The renderer asks by name; the default looks for NAME.slo on the search
// path. A program may hand in another one, such as slrender's, which also compiles NAME.sl.
#pragma once

#include "slvm/support/result.h"

#include <functional>
#include <string>
#include <vector>

namespace render {

/// The bytes of a .slo file for a shader's name and the directories to search. The error is shown to the user
/// after the request's name: "no shader ..." or what is wrong with the file.
using ShaderLoader =
    std::function<slvm::Result<std::string>(const std::string& name, const std::vector<std::string>& path)>;

/// NAME.slo (or NAME, when it ends in .slo) on the path.
slvm::Result<std::string> load_compiled_shader(const std::string& name, const std::vector<std::string>& path);

/// The error for a shader that is nowhere.
slvm::Error no_such_shader(const std::string& name, const std::vector<std::string>& path);

} // namespace render
