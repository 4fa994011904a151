// What the surroundings of a point come to: occlusion, light, and how both change when the point moves or
// turns.
#pragma once

#include "render/state/math.h"

#include <array>
#include <span>

namespace render {

/// Mean values over the rays of a point. Numbers 0: occlusion; 1 to 3: colour of hits and map; 4 to 6: colour
/// of the map; 7 to 9: direction of misses, not of length 1.
struct HemisphereSample {
  static constexpr size_t kValues = 10, kGradients = 7;
  std::array<float, kValues> value{};
  /// Of the first values: per unit the point moves, and per radian it turns about an axis (Ward and Heckbert,
  /// Irradiance Gradients, 1992).
  std::array<Vec3, kGradients> move{}, turn{};
  float distance = kInfinity; ///< harmonic mean of the distances
};

/// The mean of samples of one point.
HemisphereSample mean_of(std::span<const HemisphereSample> samples);

/// How far from a sample's point it tells anything: Ward's distance, and no farther than where, by its
/// gradients, a value changes as much as it is.
float reach_of(const HemisphereSample& sample);

/// What a sample is at another point that lies `way` from its own and whose normal is turned by `turn` (a
/// rotation vector), by its gradients; these are estimates and may not lead far.
HemisphereSample carried(const HemisphereSample& sample, Vec3 way, Vec3 turn);

/// A point to look round from.
struct HemispherePoint {
  Vec3 P, N;                         ///< N of length 1
  Vec3 along_u{0.0f}, along_v{0.0f}; ///< sides of its element
  float cone = kPi / 2, max_distance = kInfinity, bias = -1, base = 0;
  uint32_t number = 0; ///< in the grid
  uint32_t pass = 0;   ///< of several samples at one point, whose rays differ
};

} // namespace render
