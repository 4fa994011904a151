// Reading and writing .slo files. PUBLIC.
#pragma once

#include "slvm/format/program.h"
#include "slvm/support/files.h"
#include "slvm/support/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace slvm {

/// Version of the container and of the instruction set: a file of another version is refused.
inline constexpr uint8_t kSloVersion = 1;

std::vector<std::byte> write_slo(const Program& program);

/// Reads and verifies: the header, the hash, the container, then the program (verify.h). The error says what
/// is wrong, and names the foreign compilers whose files are recognised.
Result<Program> read_slo(std::span<const std::byte> bytes);

/// FNV-1a, 64 bits.
uint64_t hash_bytes(std::span<const std::byte> bytes);

} // namespace slvm
