// What shaders ask of the renderer while they run: spaces, lights, attributes, options. One for each frame,
// used from all threads.
#pragma once

#include "render/shading/bound_shaders.h"
#include "render/state/camera.h"
#include "slvm/renderer_services.h"

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>

namespace render {

class SceneServices : public slvm::RendererServices {
public:
  /// `print` gets the text of printf, one grid at a time. All arguments must outlive the services.
  SceneServices(const Scene& scene, const BoundShaders& shaders, slvm::TextureServices& textures,
                slvm::SubsurfaceServices& subsurface, slvm::PointCloudServices& point_clouds,
                std::function<void(std::string_view)> print);

  /// Spaces that procedurals name while the frame is on its way.
  void add_spaces(const std::map<std::string, Matrix4>& to_camera);

  bool space_to_current(const slvm::ShadingState&, std::string_view space, Matrix4& m) override;
  bool current_to_space(const slvm::ShadingState&, std::string_view space, Matrix4& m) override;
  std::span<const slvm::Instance* const> lights(const slvm::ShadingState&) override;
  bool attribute(const slvm::ShadingState&, std::string_view name, slvm::Value& out) override;
  bool option(const slvm::ShadingState&, std::string_view name, slvm::Value& out) override;
  bool renderer_info(const slvm::ShadingState&, std::string_view name, slvm::Value& out) override;
  void print(const slvm::ShadingState&, std::string_view text) override;
  slvm::TextureServices* textures() override { return &textures_; }
  slvm::RayServices* rays() override { return rays_; }
  slvm::SubsurfaceServices* subsurface() override { return &subsurface_; }
  slvm::PointCloudServices* point_clouds() override { return &point_clouds_; }
  slvm::IrradianceCacheServices* irradiance_caches() override { return caches_; }
  /// Who keeps irradiance caches; null: nobody.
  void set_irradiance_caches(slvm::IrradianceCacheServices* caches) { caches_ = caches; }
  slvm::PhotonMapServices* photon_maps() override { return photons_; }
  /// Who looks up photon maps; null: nobody.
  void set_photon_maps(slvm::PhotonMapServices* photons) { photons_ = photons; }
  /// Who traces rays, which asks these services in turn.
  void set_rays(slvm::RayServices* rays) { rays_ = rays; }

private:
  struct Space {
    Matrix4 to_camera, from_camera;
  };
  std::optional<Space> find_space(const slvm::ShadingState&, std::string_view name) const;

  const Scene& scene_;
  const BoundShaders& shaders_;
  slvm::TextureServices& textures_;
  slvm::SubsurfaceServices& subsurface_;
  slvm::PointCloudServices& point_clouds_;
  slvm::RayServices* rays_ = nullptr;
  slvm::IrradianceCacheServices* caches_ = nullptr;
  slvm::PhotonMapServices* photons_ = nullptr;
  std::function<void(std::string_view)> print_;
  std::mutex print_mutex_;
  mutable std::shared_mutex spaces_mutex_;
  std::map<std::string, Space, std::less<>> spaces_;
};

} // namespace render
