// Rings and sectors.
#include "render/rays/hemisphere_pattern.h"

#include <cmath>

namespace render {

namespace {

constexpr int kMostSamples = 1 << 20;

/// Rings for so many cells: cells are about as long as wide when there are PI times as many sectors as rings
/// (Ward and Heckbert 1992). A number that divides the cells is taken if its cells are not too far from that.
int rings_for(int cells) {
  double best = std::sqrt(cells / M_PI);
  int out = 0;
  for (int rings = 1; rings * rings <= cells; ++rings) {
    double ratio = rings / best;
    if (cells % rings != 0 || ratio < 0.6 || ratio > 1.6) continue;
    if (out == 0 || std::abs(std::log(ratio)) < std::abs(std::log(out / best))) out = rings;
  }
  return out > 0 ? out : std::max(1, static_cast<int>(std::lround(best)));
}

int count_of(float samples) {
  return static_cast<int>(std::clamp(std::ceil(samples), 1.0f, float{kMostSamples}));
}

} // namespace

HemispherePattern make_pattern(float samples, float fewest) {
  int all = count_of(samples), blocks = fewest > 0 ? std::min(count_of(fewest), all) : all;
  HemispherePattern p;
  int rings = rings_for(blocks), sectors = (blocks + rings - 1) / rings;
  double cells = static_cast<double>(all) / blocks;
  p.ring_block = std::max(1, static_cast<int>(std::sqrt(cells)));
  p.sector_block = std::max(1, static_cast<int>(std::ceil(cells / p.ring_block - 1e-9)));
  p.rings = rings * p.ring_block;
  p.sectors = sectors * p.sector_block;
  return p;
}

HemisphereDirection direction_in(const HemispherePattern& p, int ring, int sector, float x, float y,
                                 float cone, bool cosine_weighted) {
  float r = (static_cast<float>(ring) + x) / static_cast<float>(p.rings);
  float azimuth = 2 * kPi * (static_cast<float>(sector) + y) / static_cast<float>(p.sectors);
  float limit = std::cos(std::clamp(cone, 0.0f, kPi));
  if (!cosine_weighted) return {1 - r * (1 - limit), azimuth};
  // The part of all directions within an angle is 1 - cos^2 in front of the horizon; behind it cos^2 is
  // added.
  float whole = limit >= 0 ? 1 - limit * limit : 1 + limit * limit;
  float part = r * whole;
  return {part <= 1 ? std::sqrt(1 - part) : -std::sqrt(part - 1), azimuth};
}

void basis_about(Vec3 n, Vec3& x, Vec3& y) {
  float sign = std::copysign(1.0f, n.z);
  float a = -1 / (sign + n.z), b = n.x * n.y * a;
  x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  y = {b, sign + n.y * n.y * a, -n.y};
}

} // namespace render
