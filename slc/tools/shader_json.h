// Descriptions of compiled shaders as JSON: the schema of docs/sloinfo-schema.md.
#pragma once

#include "slc/tools/shader_description.h"

#include <span>

namespace slc {

/// All but the long listings of the code; with listings, only these. Of the parameters only `only`, if it is
/// not empty.
std::string shaders_as_json(std::span<const Inspected> shaders, const std::string& only,
                            const Listings& listings);

} // namespace slc
