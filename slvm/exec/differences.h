// Differences between neighbours on the grid: what derivatives and filter regions are made of.
//
// Inside, differences are centred; where only one neighbour holds a value (the edges of the grid, lanes
// beside others that have none) one-sided; 0 where none does, and for all of a grid without extent in that
// direction, and for what rays brought that are spread by chance. RISpec 3.2 leaves the scheme open; this is
// PRMan's default ("derivatives" "centered" 1). Points of other pieces (Lattice::kPieces) are no neighbours.
// Hits of rays (Lattice::kHits) have their own neighbours: all three points of a hit share its differences.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/exec/run.h"

namespace slvm {

class Differences {
public:
  Differences(const GridCall& call)
      : grid_(*call.run.state.grid), valid_(call.run.mask.at_level(call.level & ~kScatteredLevel)),
        everywhere_(call.level == 0),
        differ_(grid_.derivatives && !(call.level & kScatteredLevel && call.run.gathers.any_scattered())) {}

  /// Calls store(lane, lo, hi) for every point. along_u: neighbours in the row, else in the column.
  template <class F> void for_each(bool along_u, F&& store) const {
    if (grid_.lattice == Lattice::kHits) return for_each_hit(along_u, store);
    int nu = grid_.nu(), nv = grid_.nv();
    int n = along_u ? nu : grid_.rows_of_piece();
    size_t stride = along_u ? 1 : static_cast<size_t>(nu);
    for (int iv = 0; iv < nv; ++iv)
      for (int iu = 0; iu < nu; ++iu) {
        size_t lane = static_cast<size_t>(iv) * static_cast<size_t>(nu) + static_cast<size_t>(iu);
        int at = along_u ? iu : iv % n;
        size_t lo = lane, hi = lane;
        if (differ_) {
          if (at > 0 && holds(lane - stride)) lo = lane - stride;
          if (at + 1 < n && holds(lane + stride)) hi = lane + stride;
        }
        store(lane, lo, hi, (hi - lo) / stride);
      }
  }

private:
  template <class F> void for_each_hit(bool along_u, F&& store) const {
    auto hits = static_cast<size_t>(grid_.nu());
    size_t beside = grid_.nv() == 3 ? (along_u ? hits : 2 * hits) : 0;
    for (size_t lane = 0, hit = 0; lane < grid_.points(); ++lane, hit = hit + 1 == hits ? 0 : hit + 1) {
      bool both = grid_.derivatives && beside > 0 && holds(hit) && holds(hit + beside);
      store(lane, both ? hit : lane, both ? hit + beside : lane, size_t{both});
    }
  }
  bool holds(size_t lane) const { return everywhere_ || mask_test(valid_, lane); }

  const Grid& grid_;
  const MaskWord* valid_;
  bool everywhere_;
  bool differ_; ///< false: neighbours say nothing, all differences are 0
};

} // namespace slvm
