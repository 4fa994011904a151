// PLY files (G. Turk's Stanford polygon format), in general: elements with named properties, as text or
// binary. What they mean is for others: point_cloud.h, mesh.h.
//
// Own code, because Debian 12 has no library for PLY but parts of programs (assimp, VCG), which drop the
// properties that they do not know.
#pragma once

#include "slvm/support/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace subsurface {

enum class PlyType : uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat; ///< of the value, or of the items of a list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8; ///< of the length of a list
  std::vector<float> values;            ///< one for each row; empty for lists
  std::vector<double> items;            ///< of all lists, one after another
  std::vector<size_t> ends;             ///< where in `items` the list of each row ends
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const;
};

struct PlyFile {
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view element) const;
};

/// Reads the text of a file in any of its three formats. Nothing in it is believed: no more memory is taken
/// than a small multiple of its size. Errors begin with `name`, and with the line for those of the header.
slvm::Result<PlyFile> parse_ply(std::span<const std::byte> bytes, const std::string& name);

/// Files larger than this are refused.
inline constexpr size_t kMostPlyBytes = size_t{8} << 30;

} // namespace subsurface
