// A module as bytes: the `ir` part of a .slo file, from which binding a shader starts when it specialises.
//
// Little-endian, numbers in LEB128, texts counted. Only what is reachable from the body and the inits is
// written, values and instructions numbered in the order in which they stand; shadeops go by name and
// signature, because their ids change between versions. Detail is not stored: deserialise() infers it.
#pragma once

#include "slvm/ir/ir.h"
#include "slvm/support/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace slvm::ir {

std::vector<uint8_t> serialise(const Module& m);

/// Reads and verifies (verify_ir.h). The error says what is wrong: damage, or a built-in this version does
/// not have.
Result<Module> deserialise(std::span<const uint8_t> bytes);

} // namespace slvm::ir
