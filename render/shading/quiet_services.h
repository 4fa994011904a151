// The services of a renderer without its rays: what displacement shaders ask that run while the faces are
// made that rays meet.
#pragma once

#include "slvm/renderer_services.h"

#include <algorithm>

namespace render {

/// All but rays is that of `all`, which must outlive this; rays meet nothing.
class QuietServices final : public slvm::RendererServices {
public:
  explicit QuietServices(slvm::RendererServices& all) : all_(all) {}
  bool space_to_current(const slvm::ShadingState& s, std::string_view space, slvm::Matrix4& m) override {
    return all_.space_to_current(s, space, m);
  }
  bool current_to_space(const slvm::ShadingState& s, std::string_view space, slvm::Matrix4& m) override {
    return all_.current_to_space(s, space, m);
  }
  std::span<const slvm::Instance* const> lights(const slvm::ShadingState& s) override {
    return all_.lights(s);
  }
  bool attribute(const slvm::ShadingState& s, std::string_view name, slvm::Value& out) override {
    return all_.attribute(s, name, out);
  }
  bool option(const slvm::ShadingState& s, std::string_view name, slvm::Value& out) override {
    return all_.option(s, name, out);
  }
  bool renderer_info(const slvm::ShadingState& s, std::string_view name, slvm::Value& out) override {
    return all_.renderer_info(s, name, out);
  }
  slvm::TextureServices* textures() override { return all_.textures(); }
  slvm::RayServices* rays() override { return &nothing_; }
  slvm::SubsurfaceServices* subsurface() override { return all_.subsurface(); }
  slvm::PointCloudServices* point_clouds() override { return all_.point_clouds(); }
  slvm::IrradianceCacheServices* irradiance_caches() override { return all_.irradiance_caches(); }
  slvm::PhotonMapServices* photon_maps() override { return all_.photon_maps(); }
  void print(const slvm::ShadingState& s, std::string_view text) override { all_.print(s, text); }

private:
  /// A world without surfaces.
  class Nothing final : public slvm::RayServices {
  public:
    void trace(const slvm::ShadingState&, const slvm::RayOptions&, const slvm::RayBatch& batch,
               std::span<const slvm::RayOutput>, float* distance, slvm::RayCursor*) override {
      std::fill_n(distance, batch.count, slvm::kNotShot);
    }
    void transmission(const slvm::ShadingState&, const slvm::RayOptions&, const slvm::RayBatch& batch,
                      float* const (&through)[3]) override {
      for (float* plane : through)
        std::fill_n(plane, batch.count, 1.0f);
    }
    std::string hemisphere(const slvm::ShadingState&, const slvm::HemisphereQuery& q) override {
      auto clear = [&](float* plane) {
        if (plane) std::fill_n(plane, q.points, 0.0f);
      };
      clear(q.occlusion);
      for (size_t c = 0; c < 3; ++c) {
        clear(q.radiance[c]);
        clear(q.environment_colour[c]);
        clear(q.environment_direction[c]);
      }
      return "";
    }
    std::string sample_environment(const slvm::ShadingState&, const slvm::EnvironmentSamples& s) override {
      std::fill_n(s.density, s.count, 0.0f);
      return "";
    }
  };
  slvm::RendererServices& all_;
  Nothing nothing_;
};

} // namespace render
