// Named coordinate systems, as a running shader knows them.
#pragma once

#include "slvm/support/matrix.h"

#include <string_view>

namespace slvm {

class ShaderRun;

/// `forward`: the matrix from the space to "current"; else from "current" to it. False: no such space.
bool named_space(const ShaderRun& run, std::string_view space, bool forward, Matrix4& m);

/// For maps that know where their camera stood; the identity where no space is called "world".
Matrix4 current_to_world(const ShaderRun& run);

} // namespace slvm
