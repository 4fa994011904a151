// Samples of occlusion and light at places of surfaces, and what they come to between them: what a file of
// an irradiance cache holds (Christensen, "Global Illumination and All That", 3.7; chapter 3 of the SIGGRAPH
// 2003 course 9).
//
// A record is used as far as its neighbours are away from it, so that where there are none there is nothing,
// and on surfaces that face its way. Where records are dense they count alone, though sparser ones reach
// there, too: near contacts light changes fast, and samples are dense for that reason. Records with gradients
// are extrapolated along them (Ward and Heckbert, Irradiance Gradients, 1992).
#pragma once

#include "render/caches/point_table.h"
#include "render/rays/hemisphere_sample.h"
#include "stdlib/subsurface/octree.h"

#include <optional>

namespace render {

/// What a record holds.
enum CacheValue : uint32_t {
  kOcclusion = 1,            ///< value 0 of the sample
  kIrradiance = 2,           ///< values 1 to 3
  kEnvironmentColour = 4,    ///< values 4 to 6
  kEnvironmentDirection = 8, ///< values 7 to 9
  kSurroundings = 16,        ///< distance and gradients
};

struct IrradianceRecord {
  Vec3 P{0.0f}, N{0.0f}; ///< N of length 1
  float radius = 0;      ///< as far as it is used; 0: as far as its nearest neighbours are away
  uint32_t holds = 0;    ///< CacheValues, or-ed
  HemisphereSample sample;
};

/// In any order in, in one order out, with one record for each place and normal: means, of what several hold;
/// where `older` records, which stand in front, are at the same place, the newer ones count.
std::vector<IrradianceRecord> merged(std::vector<IrradianceRecord> records, size_t older = 0);

PointTable table_of(std::span<const IrradianceRecord> records);
/// Fails on tables that are something else, and on numbers that cannot be. Errors begin with `name`.
slvm::Result<std::vector<IrradianceRecord>> records_of(const PointTable& table, const std::string& name);

/// Not changed once made: any number of threads may look.
class IrradianceCache {
public:
  explicit IrradianceCache(std::vector<IrradianceRecord> records);

  struct Place {
    Vec3 P, N;
    uint32_t wanted = 0; ///< CacheValues: records that lack one do not count
    /// Ward's estimate of the error up to which records with surroundings count; negative: all do.
    float max_error = -1;
  };
  /// What the records near a place come to; none: there are none.
  std::optional<HemisphereSample> find(const Place& place) const;

  size_t size() const { return records_.size(); }
  /// CacheValues that some record holds.
  uint32_t holds() const { return holds_; }

private:
  /// Records of about the same radius.
  struct Level {
    float radius = 0; ///< the largest
    size_t first = 0; ///< its records stand side by side, in the order of its tree
    subsurface::PointOctree tree;
  };
  std::vector<IrradianceRecord> records_;
  std::vector<Level> levels_;
  uint32_t holds_ = 0;
};

} // namespace render
