// Matrices of cameras in the metadata of OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <vector>

namespace render::oiio {

/// "worldtocamera" or "worldtoscreen": 16 numbers by rows, or none.
inline std::vector<float> matrix(const OIIO::ImageSpec& spec, const char* name) {
  const OIIO::ParamValue* p = spec.find_attribute(name, OIIO::TypeMatrix);
  if (!p) return {};
  const auto* numbers = static_cast<const float*>(p->data());
  return {numbers, numbers + 16};
}

} // namespace render::oiio
