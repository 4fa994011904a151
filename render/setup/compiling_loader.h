// A shader loader that also takes sources: when the search path has NAME.sl and no NAME.slo, a NAME.slo
// whose source has changed since (slvm/format/stale.h), or one of another renderer, the source is compiled in
// memory.
#pragma once

#include "render/shading/shader_loader.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace render::setup {

/// `show` gets warnings and the compiler's messages, ready to be printed; `program` is what the former begin
/// with. `plugin_folders`: where functions of plug-ins are found.
ShaderLoader make_compiling_loader(std::string program, std::function<void(std::string_view)> show,
                                   std::vector<std::string> plugin_folders = {});

} // namespace render::setup
