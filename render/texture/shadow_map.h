// A shadow map: depths as a camera saw them, and where that camera stood.
#pragma once

#include "render/texture/lookup_block.h"
#include "slvm/support/matrix.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace render {

/// Regions of space, each about a centre, by the changes along its two sides; many at a time, by component.
/// The transforms of a map are to be those from their space.
struct ShadowRegions {
  static constexpr size_t kBlock = kLookupBlock;
  using Lanes = LookupLanes;

  alignas(64) Lanes centre[3] = {}, along_u[3] = {}, along_v[3] = {};
  alignas(64) Lanes sblur = {}, tblur = {}; ///< enlarge it by this part of the map
  alignas(64) Lanes bias = {};
  alignas(64) uint32_t turn[kBlock] = {}; ///< of the sample pattern: 2^32 is all of it
  int samples = 16;
  slvm::Matrix4 to_camera, to_screen;
};

struct ShadowMap {
  int width = 0, height = 0;
  std::vector<float> depth; ///< camera z of the nearest surface, row by row from the top
  slvm::Matrix4 world_to_camera, world_to_screen;

  /// The part of each region that is farther from the camera than the map says (percentage closer filtering,
  /// Reeves, Salesin and Cook 1987): depths are compared first, then averaged.
  void shadowed(const ShadowRegions& regions, float (&out)[ShadowRegions::kBlock]) const;
};

} // namespace render
