// Runs one program in many ways that must not matter: without and with the optimiser, specialised, in strips
// of other widths, with poisoned registers, and, if it is pointwise, each point alone.
#pragma once

#include "tests/fuzz/programs/generator.h"

#include <string>

namespace slvm::test {

/// What went wrong: a message of the compiler, or the first value that differs and where. "" if nothing did.
std::string disagreement(const RandomProgram&);

/// The shortest decisions found that still lead to a disagreement.
std::vector<uint8_t> shrink(std::vector<uint8_t> bytes);

} // namespace slvm::test
