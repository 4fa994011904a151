// A scene of RIB text whose shaders are RSL text, and rays into it: what the tests of rays share.
#pragma once

#include "render/rays/ray_tracer.h"
#include "render/shading/services.h"
#include "render/texture/texture_maps.h"
#include "stdlib/scattering/baked_clouds.h"
#include "stdlib/scattering/cloud_lookups.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace render::testing {

/// One ray and what is asked of it.
struct TestRay {
  Vec3 origin{0.0f}, direction{0, 0, 1};
  float max_distance = kInfinity, bias = -1;
};

/// What came of a ray: its distance, and the values of the outputs asked for, or nothing where there are
/// none.
struct TestHit {
  float distance = 0;
  std::vector<std::vector<float>> values;
};

class RayScene {
public:
  /// `shaders`: RSL by name. Camera space is world space: the eye is at the origin, along z.
  explicit RayScene(const std::string& rib, std::map<std::string, std::string> shaders = {},
                    std::vector<std::string> texture_folders = {});
  ~RayScene();

  /// The grid that asks: of this primitive of the scene, or (negative) of none.
  slvm::Grid& asking_grid(int nu = 1, int nv = 1, int primitive = -1);
  slvm::ShadingState state() const;

  std::vector<TestHit> trace(const std::vector<TestRay>& rays,
                             const std::vector<slvm::RayOutput>& outputs = {},
                             const slvm::RayOptions& options = {}, slvm::RayCursor* cursors = nullptr);
  float distance(const TestRay& ray, const slvm::RayOptions& options = {}) {
    return trace({ray}, {}, options)[0].distance;
  }
  /// The values of an output "surface:Ci" at the hit of a ray; empty if it was not found.
  std::vector<float> value(const TestRay& ray, const std::string& output, slvm::Type type,
                           const slvm::RayOptions& options = {});
  Color transmission(Vec3 from, Vec3 to, const slvm::RayOptions& options = {});

  RayTracer& tracer() { return *tracer_; }
  const Scene& scene() const { return scene_; }
  const std::string& messages() const { return messages_; }
  /// What shaders have printed since this was asked last.
  std::string printed() { return std::exchange(printed_, {}); }
  slvm::Machine& machine() { return machine_; }
  SceneServices& services() { return *services_; }
  /// The shaders of a primitive.
  const slvm::ShaderSet& shaders(size_t primitive) const {
    return bound_->find(&scene_.primitives[primitive].attributes())->shaders;
  }

  static slvm::RayOutput output(slvm::RayOutput::From from, std::string_view name, slvm::Type type);

private:
  slvm::Result<std::string> load(const std::string& name) const;

  std::map<std::string, std::string> shaders_;
  Scene scene_;
  std::string messages_, printed_;
  slvm::Machine machine_;
  ShaderCache cache_;
  std::unique_ptr<TextureMaps> textures_;
  subsurface::CloudCache clouds_;
  subsurface::CloudLookups lookups_{clouds_, [](std::string_view name) { return std::string(name); }};
  subsurface::BakedClouds points_;
  std::unique_ptr<BoundShaders> bound_;
  std::unique_ptr<SceneServices> services_;
  std::unique_ptr<RayTracer> tracer_;
  std::unique_ptr<slvm::Instance> running_;
  slvm::ShaderSet no_shaders_;
  Primitive asking_;
  slvm::Grid grid_{1, 1};
};

} // namespace render::testing
