// Where hemisphere rays go: a disk of rings and sectors, one ray in each cell, all cells of the same weight.
// Adaptive sampling takes blocks of cells: first one cell of each, then the rest of those blocks that differ
// from their neighbours.
#pragma once

#include "render/state/math.h"

namespace render {

struct HemispherePattern {
  int rings = 1, sectors = 1;           ///< of all cells
  int ring_block = 1, sector_block = 1; ///< cells of a block
  int blocks() const { return rings / ring_block * (sectors / sector_block); }
  int cells() const { return rings * sectors; }
};

/// A pattern of `samples` cells, or the next number that makes cells of good shapes, and at least `fewest`
/// blocks if that is fewer. fewest <= 0: no blocks.
HemispherePattern make_pattern(float samples, float fewest);

/// Cosine and azimuth of a place of a cell, x along the radius and y round, both from 0 to 1.
struct HemisphereDirection {
  float cosine, azimuth;
};
/// With `cosine_weighted`, directions are as dense as the absolute cosine to the axis, else equally dense,
/// within `cone` of the axis (up to PI).
HemisphereDirection direction_in(const HemispherePattern&, int ring, int sector, float x, float y, float cone,
                                 bool cosine_weighted);

/// Two directions of length 1 across n, which has length 1: a function of n, continuous but at n.z = 0 (Duff
/// and others, Building an Orthonormal Basis, Revisited, JCGT 2017).
void basis_about(Vec3 n, Vec3& x, Vec3& y);

} // namespace render
