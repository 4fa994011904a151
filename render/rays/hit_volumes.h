// The volume that each ray went through last before it hit something: the shaders of Interior, Exterior and
// Atmosphere, which change what is seen of the hit.
//
// A ray that leaves its surface to the inside goes through that surface's interior, else through its
// exterior. Where there is none, the surface that is hit decides in the same way, by the side it is hit on.
// Where that has none either, the air between is the Atmosphere of what is hit.
#pragma once

#include "render/rays/hit_grid.h"
#include "slvm/machine.h"

#include <functional>
#include <span>
#include <vector>

namespace render {

class HitVolumes {
public:
  /// Finds the volume of each hit. `from`: who shot the rays; `set`, `grid`: what they hit.
  void find(const slvm::ShadingState& from, const slvm::ShaderSet& set, const slvm::Grid& grid,
            const HitRays& rays, std::span<const HitRay> hits);
  /// Runs them on the grid, after its surface shader; `done` is told of each and of the hits it is for.
  void shade(slvm::ShadingContext& context, slvm::Grid& grid,
             const std::function<void(const slvm::Instance&, std::span<const uint32_t> hits)>& done);

private:
  void keep(const slvm::Grid& grid, std::vector<float>& planes) const;

  std::vector<const slvm::Instance*> volumes_; ///< of each hit; null: none
  std::vector<uint32_t> lanes_;                ///< that the shader being run is for
  std::vector<float> before_, after_;          ///< Ci and Oi
};

/// All volume shaders that hits on a surface may need.
std::vector<const slvm::Instance*> possible_volumes(const slvm::ShaderSet& from, const slvm::ShaderSet& hit);

} // namespace render
