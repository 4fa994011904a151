// Ray scenes by the renderer: the module sltest_rays.so.
#include "render/caches/cache_files.h"
#include "render/photons/photon_maps.h"
#include "render/rays/ray_tracer.h"
#include "render/shading/services.h"
#include "render/state/interpreter.h"
#include "render/state/search_path.h"
#include "render/texture/texture_maps.h"
#include "slvm/tools/sltest/ray_scene.h"
#include "stdlib/scattering/cloud_lookups.h"

namespace slvm::sltest {
namespace {

/// What stands behind the last object tells the attributes of the grid under test, by a surface that is taken
/// away again.
constexpr const char* kLast = "\nSphere 1 -1 1 360\nWorldEnd\n";

class RenderedScene final : public RayScene {
public:
  explicit RenderedScene(const RaySceneRequest& request)
      : cache_(*request.machine,
               [shader = request.shader](const std::string& name, const std::vector<std::string>&) {
                 return shader(name);
               }) {
    SourceManager sources;
    Diagnostics diagnostics;
    render::Interpreter interpreter(sources, diagnostics,
                                    [&](render::Scene& scene) { scene_ = std::move(scene); });
    interpreter.options().search_paths["texture"] = interpreter.options().search_paths["archive"] =
        request.path;
    // On the line where the text begins, so that messages count from there.
    interpreter.read_text(request.name,
                          "Projection \"perspective\" \"fov\" 60 WorldBegin " + request.rib + kLast);
    interpreter.finish();
    render::RayAttributes own;
    if (!scene_.primitives.empty()) {
      own = scene_.primitives.back().attributes().rays;
      scene_.primitives.pop_back();
    }
    render::TextureMaps::Settings settings;
    settings.folders = request.path;
    textures_ = std::make_unique<render::TextureMaps>(settings);
    bound_ = std::make_unique<render::BoundShaders>(scene_, *request.machine, cache_, diagnostics);
    auto find = [path = request.path](std::string_view name) {
      return render::find_file(name, path).value_or(std::string(name));
    };
    lookups_ = std::make_unique<subsurface::CloudLookups>(clouds_, find);
    caches_ = std::make_unique<render::CacheFiles>(find);
    photons_ = std::make_unique<render::PhotonMaps>(find);
    services_ = std::make_unique<render::SceneServices>(scene_, *bound_, *textures_, *lookups_,
                                                        [](std::string_view) {});
    tracer_ = std::make_unique<render::RayTracer>(scene_, *request.machine, *bound_, *services_);
    tracer_->set_default_attributes(own);
    tracer_->set_cache_files(caches_.get());
    tracer_->set_photon_maps(photons_.get());
    services_->set_rays(tracer_.get());
    services_->set_irradiance_caches(caches_.get());
    services_->set_photon_maps(photons_.get());
    problem_ = format_diagnostics(diagnostics, sources);
  }

  RayServices& rays() override { return *tracer_; }
  IrradianceCacheServices& irradiance_caches() override { return *caches_; }
  PhotonMapServices& photon_maps() override { return *photons_; }
  const std::string& problem() const override { return problem_; }

private:
  render::ShaderCache cache_;
  render::Scene scene_;
  std::unique_ptr<render::TextureMaps> textures_;
  std::unique_ptr<render::BoundShaders> bound_;
  subsurface::CloudCache clouds_;
  std::unique_ptr<subsurface::CloudLookups> lookups_;
  std::unique_ptr<render::CacheFiles> caches_;
  std::unique_ptr<render::PhotonMaps> photons_;
  std::unique_ptr<render::SceneServices> services_;
  std::unique_ptr<render::RayTracer> tracer_;
  std::string problem_;
};

} // namespace
} // namespace slvm::sltest

/// To be deleted by the caller.
extern "C" slvm::sltest::RayScene* sltest_make_ray_scene(const slvm::sltest::RaySceneRequest& request) {
  return new slvm::sltest::RenderedScene(request);
}
