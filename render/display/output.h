// From the Display requests and a finished image to files. Types are formats of OpenImageIO; a file is
// written under a temporary name and renamed when complete.
#pragma once

#include "render/display/channels.h"
#include "render/hider/image.h"
#include "render/state/scene.h"
#include "slvm/support/diagnostics.h"

#include <string>
#include <vector>

namespace render {

/// Writes all displays. Errors go to `diagnostics` at the Display request's position. Returns the names of
/// the files written.
std::vector<std::string> write_displays(const Scene& scene, const Image& image,
                                        const std::vector<AovChannel>& aovs, slvm::Diagnostics& diagnostics);

} // namespace render
