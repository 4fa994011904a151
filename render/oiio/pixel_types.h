// Types of pixels as OpenImageIO has them.
#pragma once

#include "render/texture/pixels.h"

#include <OpenImageIO/typedesc.h>

namespace render::oiio {

inline OIIO::TypeDesc type_of(PixelType type) {
  if (type == PixelType::kByte) return OIIO::TypeDesc::UINT8;
  return type == PixelType::kShort ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}
/// The one that holds all of them.
inline PixelType type_for(OIIO::TypeDesc type) {
  if (type == OIIO::TypeDesc::UINT8) return PixelType::kByte;
  return type == OIIO::TypeDesc::UINT16 ? PixelType::kShort : PixelType::kFloat;
}

} // namespace render::oiio
