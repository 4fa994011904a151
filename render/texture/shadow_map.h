// A shadow map: depths as a camera saw them, and where that camera stood.
#pragma once

#include "slvm/support/matrix.h"

#include <cstdint>
#include <vector>

namespace render {

class ShadowMap {
public:
  int width = 0, height = 0;
  std::vector<float> depth; ///< camera z of the nearest surface, row by row from the top
  slvm::Matrix4 world_to_camera, world_to_screen;

  /// A region of space about `centre`, in world space, by the changes along its two sides.
  struct Region {
    float centre[3], along_u[3], along_v[3];
    float sblur = 0, tblur = 0; ///< enlarge it by this part of the map
    float bias = 0;
    int samples = 16;
    uint32_t seed = 0; ///< turns the sample pattern
  };
  /// The part of the region that is farther from the camera than the map says (percentage closer filtering,
  /// Reeves, Salesin and Cook 1987): depths are compared first, then averaged.
  float shadowed(const Region&) const;
};

} // namespace render
