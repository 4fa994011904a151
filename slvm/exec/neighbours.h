// Which part of a shader has to run at the points beside hits of rays (Lattice::kHits), for its derivatives'
// sake, and what that part reads.
#pragma once

#include "slvm/machine.h"

namespace slvm {

struct NeighbourUse {
  uint32_t end = 0; ///< Instance::Bound::neighbours_end; 0: the shader has no derivatives
  BesideReads reads;
};

NeighbourUse find_neighbour_use(const Program& program);

} // namespace slvm
