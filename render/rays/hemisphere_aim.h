// Where the rays of a hemisphere sample start and go, for all rays of a point at once.
#pragma once

#include "render/rays/hemisphere_pattern.h"
#include "render/rays/hemisphere_sample.h"

#include <cstdint>
#include <span>
#include <vector>

namespace render {

class HemisphereAim {
public:
  /// `cosine_weighted`: see CosineOfRadius.
  HemisphereAim(const HemispherePattern& pattern, bool cosine_weighted);

  /// The rays that are shot first: one in each block.
  void first(const HemispherePoint& point, uint64_t seed);
  /// All others of blocks that are `wanted` (1, else 0); `chosen`: the cells of the first rays.
  void others(const HemispherePoint& point, uint64_t seed, std::span<const uint8_t> wanted,
              std::span<const int> chosen);

  // Results, one a ray.
  size_t size() const { return cell.size(); }
  std::vector<int> cell;
  std::vector<float> direction[3];
  std::vector<float> origin[3];

private:
  void draw(const HemispherePoint& point, uint64_t seed, size_t first, size_t last,
            std::span<const uint8_t> wanted = {});
  void keep_wanted(std::span<const uint8_t> wanted);
  void draw_in_cells(const HemispherePoint& point, uint64_t seed, std::span<const int> cells);
  int random_cell(int block, uint64_t seed) const;
  void finish(const HemispherePoint& point);

  HemispherePattern pattern_;
  bool cosine_weighted_;
  std::vector<uint32_t> block_of_;    ///< by cell
  std::vector<uint32_t> kept_;        ///< of the samples drawn last, those in wanted blocks
  std::vector<uint32_t> kept_bits_;   ///< and their numbers before they are scrambled
  std::vector<uint32_t> sequence_[4]; ///< by use, where the pattern is a net
  std::vector<float> radius_, turn_;  ///< from 0 to 1: places in the disk
  std::vector<float> base_[2];        ///< and on the element
};

} // namespace render
