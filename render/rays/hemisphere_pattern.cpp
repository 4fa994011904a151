// Rings and sectors.
#include "render/rays/hemisphere_pattern.h"

#include <bit>
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

bool HemispherePattern::is_net() const {
  for (int n : {rings, sectors, ring_block, sector_block})
    if (!std::has_single_bit(static_cast<unsigned>(n))) return false;
  return true;
}

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

void basis_about(Vec3 n, Vec3& x, Vec3& y) {
  float sign = std::copysign(1.0f, n.z);
  float a = -1 / (sign + n.z), b = n.x * n.y * a;
  x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  y = {b, sign + n.y * n.y * a, -n.y};
}

} // namespace render
