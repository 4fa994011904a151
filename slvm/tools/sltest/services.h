// A renderer in memory: what sltest answers when a running shader asks for spaces, lights, attributes and
// options.
//
// "world" and "camera" are "current" unless the test says otherwise. The camera is orthographic: "screen" has
// x and y of the camera and z from 0 at the near to 1 at the far clipping plane; "NDC" maps the screen window
// [-1, 1] to [0, 1], y downwards; "raster" is NDC times the resolution of the grid. The clipping planes are
// those of the option Clipping, 0 and 1 by default.
#pragma once

#include "slvm/machine.h"
#include "slvm/tools/sltest/ray_scene.h"
#include "stdlib/scattering/baked_clouds.h"
#include "stdlib/scattering/cloud_lookups.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace slvm::sltest {

/// Textures by the module, loaded when one is asked for.
class LazyTextures {
public:
  explicit LazyTextures(std::vector<std::string> path) : path_(std::move(path)) {}
  /// Null where there is no module.
  TextureServices* get(float shadow_bias);

private:
  std::vector<std::string> path_;
  std::mutex mutex_;
  bool loaded_ = false;
  std::unique_ptr<TextureServices> textures_;
};

/// Clouds of points for subsurface() and plug-ins, of one case.
struct Clouds {
  explicit Clouds(std::vector<std::string> path);

  subsurface::ReadClouds files;
  subsurface::CloudCache cache;
  subsurface::CloudLookups lookups;
};

/// What all runs of a case see of the world.
struct Scene {
  std::shared_ptr<LazyTextures> textures;
  std::shared_ptr<Clouds> clouds;
  std::map<std::string, Matrix4, std::less<>> spaces; ///< to "current"
  std::map<std::string, Value, std::less<>> attributes, options;
};

class MemoryServices final : public RendererServices {
public:
  /// `ray_scene`, what rays see, may be null. Its options are told where the test gives none.
  MemoryServices(const Scene& scene, std::vector<const Instance*> lights, RayScene* ray_scene = nullptr)
      : scene_(scene), lights_(std::move(lights)), ray_scene_(ray_scene) {}

  bool space_to_current(const ShadingState&, std::string_view space, Matrix4& m) override;
  bool current_to_space(const ShadingState&, std::string_view space, Matrix4& m) override;
  std::span<const Instance* const> lights(const ShadingState&) override { return lights_; }
  bool attribute(const ShadingState&, std::string_view name, Value& out) override;
  bool option(const ShadingState&, std::string_view name, Value& out) override;
  bool renderer_info(const ShadingState&, std::string_view name, Value& out) override;
  void print(const ShadingState&, std::string_view text) override { printed_ += text; }
  TextureServices* textures() override;
  RayServices* rays() override { return ray_scene_ ? &ray_scene_->rays() : nullptr; }
  IrradianceCacheServices* irradiance_caches() override {
    return ray_scene_ ? &ray_scene_->irradiance_caches() : nullptr;
  }
  PhotonMapServices* photon_maps() override { return ray_scene_ ? &ray_scene_->photon_maps() : nullptr; }
  SubsurfaceServices* subsurface() override { return scene_.clouds ? &scene_.clouds->lookups : nullptr; }
  PointCloudServices* point_clouds() override { return scene_.clouds ? &scene_.clouds->files : nullptr; }

  const std::string& printed() const { return printed_; }
  void forget_printed() { printed_.clear(); }

private:
  const Scene& scene_;
  std::vector<const Instance*> lights_;
  RayScene* ray_scene_;
  std::string printed_;
};

} // namespace slvm::sltest
