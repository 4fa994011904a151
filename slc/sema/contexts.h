// The second half of semantic analysis: what depends on where code is inlined. Walks every shader with its
// function calls expanded and works out which values vary; reports varying values where uniform ones are
// needed, access to predefined variables a shader does not have, and light loops in the wrong place.
#pragma once

#include "slc/ast/unit.h"
#include "slvm/support/diagnostics.h"

namespace slc {

/// Most calls one shader may expand to.
inline constexpr size_t kMaxInlinedCalls = 20'000;

/// `unit` has been through Checker; it may have errors.
void check_contexts(TranslationUnit& unit, slvm::Diagnostics& diags);

} // namespace slc
