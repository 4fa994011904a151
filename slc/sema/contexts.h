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

/// Why the variables of this name in the shader and the functions it calls are varying, or that they are
/// uniform: an answer for each, as steps from the variable to what varies by itself. `shader` has been
/// through check_contexts().
std::vector<std::vector<slvm::Note>> explain_varying(Shader& shader, std::string_view name);

} // namespace slc
