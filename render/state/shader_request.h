// A shader as a scene names it: Surface "plastic" "Kd" 0.8, with the space it was named in. It is looked up,
// loaded and bound when the first primitive needs it.
#pragma once

#include "render/rib/request.h"
#include "render/state/declaration.h"
#include "render/state/math.h"

#include <optional>
#include <string>
#include <vector>

namespace render {

struct ShaderParam {
  std::string name;
  std::optional<Declaration> declaration; ///< none: the shader's own declaration decides
  std::vector<float> numbers;
  std::vector<std::string> strings;
  slvm::SourceRange where;
};

struct ShaderRequest {
  RequestId kind = RequestId::kSurface; ///< Surface, Displacement, LightSource, AreaLightSource, Atmosphere,
                                        ///< Interior, Exterior, Imager
  std::string name;
  std::vector<ShaderParam> params;
  Matrix4 shader_to_camera;
  std::string handle;    ///< of lights
  uint32_t samples = 16; ///< of area lights: points of their surface for each point they light
  slvm::SourceRange where;
};

} // namespace render
