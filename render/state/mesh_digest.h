// Tells large meshes apart: by what the request says, wherever it came from - an object, an archive that is
// read again, or the same numbers once more.
#pragma once

#include "render/state/declaration.h"

#include <array>
#include <optional>

namespace render {

/// 128 bits: two different meshes of one scene do not have the same by chance.
using MeshDigest = std::array<uint64_t, 2>;

/// Of all arguments and parameters, with the types these are declared of. Nothing for small requests, which
/// are made as fast as they are found again.
std::optional<MeshDigest> digest_of(const RequestCall&, const Declarations&);

} // namespace render
