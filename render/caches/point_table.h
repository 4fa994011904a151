// Points with columns of numbers, each with a name: the files that irradiance caches and photon maps are
// kept in. docs/caches.md says what they are like byte by byte. What the columns mean is for others:
// irradiance_cache.h.
#pragma once

#include "slvm/support/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace render {

struct PointColumn {
  std::string name;
  uint32_t components = 1;
  std::vector<float> values; ///< component c of point i at [i * components + c]
};

struct PointTable {
  std::string kind; ///< what it is: "irradiance cache", "photon map"
  size_t points = 0;
  std::vector<PointColumn> columns;

  /// The column of this name, if it has so many components.
  const PointColumn* find(std::string_view name, uint32_t components) const;
  /// Adds a column of zeros and returns its values.
  std::vector<float>& add(std::string name, uint32_t components);
};

std::vector<std::byte> format_point_table(const PointTable& table);
/// Nothing in the bytes is believed, and no more memory taken than they have; numbers are finite. Errors
/// begin with `name`, and say what to do.
slvm::Result<PointTable> parse_point_table(std::span<const std::byte> bytes, const std::string& name);

/// Larger files are refused.
inline constexpr size_t kMostTableBytes = size_t{8} << 30;

slvm::Result<PointTable> read_point_table(const std::string& path);
/// Into a temporary file, then renamed, so that readers never see half of one.
slvm::Result<bool> write_point_table(const std::string& path, const PointTable& table);

} // namespace render
