// slvm::RayServices over a scene: what shaders' rays see. One for each frame, used from all threads.
//
// Results are functions of the scene and the call: which thread asks first, or when, changes nothing. Rays
// are ended here: by the depth limits of the objects they come from (Attribute "trace"), by Option "trace"
// "maxdepth", and where they weigh less than Option "trace" "minweight".
#pragma once

#include "render/rays/hit_shader.h"
#include "render/rays/ray_geometry.h"

namespace render {

class CacheFiles;
class HemisphereCache;
class HemisphereRecords;

class RayTracer final : public slvm::RayServices {
public:
  /// All arguments must outlive this. `services` is what shaders at hits ask; its rays() may be this.
  RayTracer(const Scene& scene, const slvm::Machine& machine, const BoundShaders& shaders,
            slvm::RendererServices& services);
  ~RayTracer() override;

  /// What grids that are of no primitive of the scene shoot with.
  void set_default_attributes(const RayAttributes& a) { default_attributes_ = a; }

  /// Files that occlusion() and indirectdiffuse() read and write; null: none. They must outlive this.
  void set_cache_files(CacheFiles* files) { cache_files_ = files; }

  /// Photon maps that diffuse rays take light from; null: none. They must outlive this.
  void set_photon_maps(PhotonMaps* maps) { hits_.set_photon_maps(maps); }
  /// Before the first ray: all rays come from one thread, which has the processors to itself.
  void set_alone() { geometry_settings_.alone = true; }
  /// Before the first ray: specular rays are photons, by what they see.
  void show_to_photons() { geometry_settings_.photons = true; }

  bool is_empty() override { return geometry().items() == 0; }
  void trace(const slvm::ShadingState& state, const slvm::RayOptions&, const slvm::RayBatch&,
             std::span<const slvm::RayOutput> outputs, float* distance, slvm::RayCursor* cursors) override;
  void transmission(const slvm::ShadingState& state, const slvm::RayOptions&, const slvm::RayBatch&,
                    float* const (&through)[3]) override;
  std::string hemisphere(const slvm::ShadingState& state, const slvm::HemisphereQuery&) override;
  std::string sample_environment(const slvm::ShadingState& state, const slvm::EnvironmentSamples&) override;

  /// Why rays hit nothing that should be hit; empty: they do.
  std::string problem() const;
  RayUsage usage() const;

private:
  friend class HemisphereSampler;
  struct Shooter;
  class HemisphereRun;

  const RayAttributes& attributes_of(const slvm::Grid& grid) const {
    const auto* primitive = static_cast<const Primitive*>(grid.user);
    return primitive ? primitive->attributes().rays : default_attributes_;
  }
  /// Made by the first ray.
  RayGeometry& geometry();
  Shooter shooter(const slvm::ShadingState& state, const slvm::RayOptions& options) const;
  /// The number of rays shot, which is not counted here.
  size_t trace_by(const Shooter&, const slvm::RayOptions&, const slvm::RayBatch&,
                  std::span<const slvm::RayOutput> outputs, float* distance, slvm::RayCursor* cursors);
  RaySegment segment(const Shooter&, const slvm::RayOptions&, const slvm::RayBatch&, size_t ray) const;
  HitRay hit_ray(const Shooter&, const slvm::RayBatch&, size_t ray, float time, const RayHit&);
  /// Parts of the picture that rays make; empty: all of it.
  std::vector<Color> weights(const Shooter&, const slvm::RayBatch&) const;
  void shade_layers(const Shooter&, const slvm::RayOptions&, const slvm::RayBatch&,
                    std::vector<struct LightPath>&);

  const Scene& scene_;
  slvm::RendererServices& services_;
  Camera camera_;
  HitShader hits_;
  CacheFiles* cache_files_ = nullptr;
  RayAttributes default_attributes_;
  float min_weight_ = 0, max_depth_ = 10;
  RayGeometrySettings geometry_settings_;
  std::once_flag geometry_made_;
  std::unique_ptr<RayGeometry> geometry_;
  std::unique_ptr<HemisphereCache> cache_;
  std::unique_ptr<HemisphereRecords> records_;
  std::mutex maps_mutex_;
  std::map<std::string, std::unique_ptr<class EnvironmentDistribution>, std::less<>> maps_;
  std::atomic<size_t> rays_{0}, shadow_rays_{0}, hemisphere_rays_{0}, hemispheres_{0};
};

} // namespace render
