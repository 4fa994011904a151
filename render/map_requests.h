// MakeTexture, MakeBump, MakeLatLongEnvironment, MakeCubeFaceEnvironment, MakeShadow: from the request to the
// file.
#pragma once

#include "render/rib/request.h"
#include "render/state/options.h"

#include <string>

namespace render {

/// Makes the map. "": done, else what is wrong.
std::string make_map(const RequestCall& call, const Options& options);

} // namespace render
