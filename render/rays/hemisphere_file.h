// The file of an irradiance cache behind occlusion() and indirectdiffuse(): Attribute "irradiance" "handle"
// and "filemode".
#pragma once

#include "render/caches/cache_files.h"
#include "render/caches/cache_space.h"
#include "render/state/ray_attributes.h"
#include "slvm/renderer_services.h"

namespace render {

/// For one query, in one thread.
class HemisphereFile {
public:
  /// `files` may be null: then there is none.
  HemisphereFile(CacheFiles* files, const slvm::ShadingState& state, const slvm::HemisphereQuery& query,
                 slvm::RendererServices& services, const RayAttributes& attributes);

  /// Nothing but the file counts: no rays are shot.
  bool is_all() const { return mode_ == CacheMode::kOnly; }
  /// Samples are to be kept. Not those of points that rays hit: which there are, and how dense, is chance.
  bool writes() const { return writes_; }

  /// What the file says of a point; with max_error of Ward's estimate, unless it is all there is.
  std::optional<HemisphereSample> find(const HemispherePoint& point, float max_error) const;
  /// `radius`: as of IrradianceRecord. `interpolated`: the sample has surroundings.
  void keep(const HemispherePoint& point, const HemisphereSample& sample, float radius, bool interpolated);
  /// Hands over what was kept.
  void finish();
  /// Why the file cannot be used, or "".
  const std::string& problem() const { return problem_; }

private:
  CacheFiles* files_;
  const RayAttributes& attributes_;
  CacheMode mode_ = CacheMode::kNone;
  bool writes_ = false;
  uint32_t wanted_ = 0; ///< CacheValues that the query asks for
  std::optional<CacheSpace> space_;
  const IrradianceCache* cache_ = nullptr;
  std::vector<IrradianceRecord> kept_;
  std::string problem_;
};

/// How far each of some samples on a lattice is used: twice as far as the farthest place that it is nearest
/// to, so that the samples round a place have it in common. `samples` are numbers of points.
std::vector<float> sample_radii(std::span<const HemispherePoint> points, int nu, int nv, const uint64_t* mask,
                                std::span<const uint32_t> samples);

} // namespace render
