// Differences between neighbours on the grid: what derivatives and filter regions are made of.
//
// Inside, differences are centred; where only one neighbour holds a value (the edges of the grid, lanes
// beside others that have none) one-sided; 0 where none does, and for all of a grid without extent in that
// direction, for what rays brought that are spread by chance, and in area lights, whose points are.
// RISpec 3.2 leaves the scheme open; this is PRMan's default ("derivatives" "centered" 1). Points of other
// pieces (Lattice::kPieces) are no neighbours. Hits of rays (Lattice::kHits) have their own neighbours: all
// three points of a hit share its differences.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/exec/run.h"

namespace slvm {

class Differences {
public:
  Differences(const GridCall& call)
      : grid_(*call.run.state.grid), points_(call.run.points),
        valid_(call.run.mask.at_level(call.level & ~kScatteredLevel)),
        everywhere_(call.level == 0 || mask_all(valid_, call.run.points)),
        derivatives_(grid_.derivatives && !call.run.on_emitter),
        differ_(derivatives_ && !(call.level & kScatteredLevel && call.run.gathers.any_scattered())) {}

  /// Points that follow each other, as their neighbours do: `lo` and `hi` are those of the first, `steps`
  /// steps of the grid apart, or itself where it has none there.
  struct Run {
    size_t first, count, lo, hi, steps;
  };

  /// Calls f(Run) for all points. along_u: neighbours in the row, else in the column.
  template <class F> void for_each_run(bool along_u, F&& f) const {
    if (grid_.lattice == Lattice::kHits) return for_each_hit(along_u, f);
    const size_t points = grid_.points(), row = static_cast<size_t>(grid_.nu());
    // Lines of neighbours: rows of points, or columns side by side, which are pieces of rows of rows.
    const size_t stride = along_u ? 1 : row, n = along_u ? row : static_cast<size_t>(grid_.rows_of_piece());
    if (!differ_ || n == 1) return f(Run{0, points, 0, 0, 0});
    for (size_t first = 0; first < points; first += n * stride) {
      if (everywhere_) {
        const size_t last = first + (n - 1) * stride;
        f(Run{first, stride, first, first + stride, 1});
        if (n > 2) f(Run{first + stride, (n - 2) * stride, first, first + 2 * stride, 2});
        f(Run{last, stride, last - stride, last, 1});
        continue;
      }
      for (size_t lane = first, end = first + n * stride; lane < end; ++lane) {
        const size_t lo = lane - first >= stride && holds(lane - stride) ? lane - stride : lane,
                     hi = lane + stride < end && holds(lane + stride) ? lane + stride : lane;
        f(Run{lane, 1, lo, hi, (hi - lo) / stride});
      }
    }
  }

  /// Calls store(lane, lo, hi, steps) for all points, with the lanes of the neighbours.
  template <class F> void for_each(bool along_u, F&& store) const {
    for_each_run(along_u, [&](const Run& run) {
      for (size_t i = 0; i < run.count; ++i)
        store(run.first + i, run.lo + i, run.hi + i, run.steps);
    });
  }

private:
  template <class F> void for_each_hit(bool along_u, F&& f) const {
    auto hits = static_cast<size_t>(grid_.nu());
    size_t beside = grid_.nv() == 3 ? (along_u ? hits : 2 * hits) : 0;
    for (size_t lane = 0, hit = 0; lane < points_; ++lane, hit = hit + 1 == hits ? 0 : hit + 1) {
      bool both = derivatives_ && beside > 0 && holds(hit) && holds(hit + beside);
      f(both ? Run{lane, 1, hit, hit + beside, 1} : Run{lane, 1, lane, lane, 0});
    }
  }
  bool holds(size_t lane) const { return everywhere_ || mask_test(valid_, lane); }

  const Grid& grid_;
  size_t points_; ///< that differences are wanted of: of hits, those with neighbours or without
  const MaskWord* valid_;
  bool everywhere_;
  bool derivatives_; ///< false: all differences are 0
  bool differ_;      ///< false: neighbours say nothing, all differences are 0
};

} // namespace slvm
