// Is a module sound? What the passes and emit() take for granted, checked: after verify_module() they may run
// on a module from anywhere. Detail is not checked here, passes infer it; verify_program() judges the code
// that emit() makes from it.
#pragma once

#include "slvm/ir/ir.h"

#include <string>

namespace slvm::ir {

/// Limits a module must keep, so that a hostile one cannot ask for absurd time or memory.
inline constexpr uint32_t kMaxInstructions = 1u << 20;
inline constexpr uint32_t kMaxNesting = 200; ///< regions in regions
inline constexpr uint32_t kMaxArgs = 4096;   ///< of one instruction

/// "" when sound, else what is wrong, with the number of the instruction concerned.
std::string verify_module(const Module& m);

} // namespace slvm::ir
