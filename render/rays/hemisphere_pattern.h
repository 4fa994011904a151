// Where hemisphere rays go: a disk of rings and sectors, one ray in each cell, all cells of the same weight.
// Adaptive sampling takes blocks of cells: first one cell of each, then the rest of those blocks that differ
// from their neighbours.
//
// Where all numbers of cells are powers of two, rays are where a scrambled Sobol sequence has its samples: of
// these, too, there is one in each cell and, of the first ones, one in each block; they are evener than
// random places in cells, and so are sums over them.
#pragma once

#include "render/state/math.h"

#include <algorithm>
#include <cmath>

namespace render {

struct HemispherePattern {
  int rings = 1, sectors = 1;           ///< of all cells
  int ring_block = 1, sector_block = 1; ///< cells of a block
  int blocks() const { return rings / ring_block * (sectors / sector_block); }
  int cells() const { return rings * sectors; }
  int block_of(int cell) const {
    return cell / sectors / ring_block * (sectors / sector_block) + cell % sectors / sector_block;
  }
  /// Whether samples of a sequence fit.
  bool is_net() const;
};

/// A pattern of `samples` cells, or the next number that makes cells of good shapes, and at least `fewest`
/// blocks if that is fewer. fewest <= 0: no blocks.
HemispherePattern make_pattern(float samples, float fewest);

/// The cosine to the axis by the radius in the disk, from 0 to 1. With `cosine_weighted`, directions are as
/// dense as the absolute cosine to the axis, else equally dense, within `cone` of the axis (up to PI).
class CosineOfRadius {
public:
  CosineOfRadius(float cone, bool cosine_weighted)
      : weighted_(cosine_weighted), limit_(std::cos(std::clamp(cone, 0.0f, kPi))) {
    // The part of all directions within an angle is 1 - cos^2 in front of the horizon; behind it cos^2 is
    // added.
    whole_ = !weighted_ ? 1 - limit_ : limit_ >= 0 ? 1 - limit_ * limit_ : 1 + limit_ * limit_;
  }
  float operator()(float radius) const {
    const float part = radius * whole_;
    if (!weighted_) return 1 - part;
    const float squared = 1 - part, root = std::sqrt(std::abs(squared));
    return squared >= 0 ? root : -root;
  }

private:
  bool weighted_;
  float limit_, whole_;
};

/// Two directions of length 1 across n, which has length 1: a function of n, continuous but at n.z = 0 (Duff
/// and others, Building an Orthonormal Basis, Revisited, JCGT 2017).
void basis_about(Vec3 n, Vec3& x, Vec3& y);

} // namespace render
