// What the surroundings of a point come to: occlusion, light, and how both change when the point moves or
// turns.
#pragma once

#include "render/state/math.h"

#include <array>

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

/// A point to look round from.
struct HemispherePoint {
  Vec3 P, N;                         ///< N of length 1
  Vec3 along_u{0.0f}, along_v{0.0f}; ///< sides of its element
  float cone = kPi / 2, max_distance = kInfinity, bias = -1, base = 0;
  uint32_t number = 0; ///< in the grid
};

} // namespace render
