// The header of a PLY file: what ply.cpp reads the data by.
#pragma once

#include "stdlib/subsurface/ply.h"

namespace subsurface {

enum class PlyFormat : uint8_t { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements; ///< without values
  size_t bytes = 0;                 ///< the data begin here
};

slvm::Result<PlyHeader> parse_ply_header(std::string_view text, const std::string& name);
size_t size_of(PlyType type);

} // namespace subsurface
