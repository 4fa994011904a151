// Who traces the rays of random programs: planes all over, whose colours tell where they were hit.
#pragma once

#include "slvm/rays.h"

namespace slvm::test {

/// Planes z = -3, 0 and 2.5, half transparent. Any ray gets an answer that depends on the ray alone.
class SceneOfPlanes : public RayServices {
public:
  void trace(const ShadingState&, const RayOptions&, const RayBatch&, std::span<const RayOutput>,
             float* distance, RayCursor*) override;
  void transmission(const ShadingState&, const RayOptions&, const RayBatch&,
                    float* const (&through)[3]) override;
  std::string hemisphere(const ShadingState&, const HemisphereQuery&) override;
  std::string sample_environment(const ShadingState&, const EnvironmentSamples&) override {
    return "no maps";
  }
};

} // namespace slvm::test
