// A scene of balls for the benchmarks of rays: what it takes for a ray is about what a fast ray tracer takes
// in a scene of some size. It keeps the rays it is asked for, so that the same ones can be traced without the
// virtual machine.
#pragma once

#include "slvm/rays.h"

#include <vector>

namespace bench {

struct RayCall {
  std::vector<float> origin[3], direction[3];
  std::vector<uint32_t> point;
};

class BallScene : public slvm::RayServices {
public:
  BallScene();
  bool keeps = false;
  std::vector<RayCall> kept;

  void trace(const slvm::ShadingState&, const slvm::RayOptions&, const slvm::RayBatch&,
             std::span<const slvm::RayOutput>, float* distance, slvm::RayCursor*) override;
  void transmission(const slvm::ShadingState&, const slvm::RayOptions&, const slvm::RayBatch&,
                    float* const (&)[3]) override {}
  std::string hemisphere(const slvm::ShadingState&, const slvm::HemisphereQuery&) override { return ""; }
  std::string sample_environment(const slvm::ShadingState&, const slvm::EnvironmentSamples&) override {
    return "";
  }

  /// Distances to the balls, and where `colour` is not null the colour of what is hit, `count` floats a
  /// component.
  void nearest(const float* const (&origin)[3], const float* const (&direction)[3], size_t count,
               float* distance, float* colour, uint8_t* found) const;

private:
  struct Ball {
    float centre[3], squared_radius;
  };
  std::vector<Ball> balls_;
};

/// The kept rays once more: for each of the points 1 less the part of its rays that hits.
void occlusion_by_hand(const BallScene&, float samples, size_t points, float* const (&ci)[3]);
/// The mean colour of what they hit.
void bleeding_by_hand(const BallScene&, float samples, size_t points, float* const (&ci)[3]);

} // namespace bench
