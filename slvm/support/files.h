// Whole files in and out. PUBLIC.
#pragma once

#include "slvm/support/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace slvm {

/// Larger files are refused before they are read, unless the caller expects them.
inline constexpr size_t kMostFileBytes = size_t{256} << 20;

/// Reads a whole file of at most `most` bytes. Errors name the path.
Result<std::vector<std::byte>> read_file(const std::string& path, size_t most = kMostFileBytes);
/// Writes to a temporary name beside `path` and renames, so that no reader ever sees half a file.
Result<bool> write_file(const std::string& path, std::span<const std::byte> bytes);

} // namespace slvm
