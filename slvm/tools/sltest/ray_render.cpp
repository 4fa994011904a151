// Ray scenes by the renderer: the module sltest_rays.so.
#include "render/caches/cache_files.h"
#include "render/photons/photon_maps.h"
#include "render/rays/ray_tracer.h"
#include "render/rib/parser.h"
#include "render/shading/services.h"
#include "render/state/interpreter.h"
#include "render/state/search_path.h"
#include "render/texture/texture_maps.h"
#include "slvm/tools/sltest/ray_scene.h"
#include "stdlib/scattering/baked_clouds.h"
#include "stdlib/scattering/cloud_lookups.h"

namespace slvm::sltest {
namespace {

/// What stands behind the last object tells the attributes of the grid under test, by a surface that is taken
/// away again.
constexpr const char* kLast = "\nSphere 1 -1 1 360\nWorldEnd\n";

/// Opens the world behind the options that a scene begins with, if it does not do so itself.
class WorldOpener final : public render::RiTarget {
public:
  WorldOpener(render::Interpreter& interpreter, std::string folder)
      : interpreter_(interpreter), folder_(std::move(folder)) {}

  void request(const render::RequestCall& call) override {
    using render::RequestId;
    const bool of_options = call.id == RequestId::kOption || call.id == RequestId::kDeclare ||
                            (call.info().outside && !call.info().world);
    if (!open_ && !of_options) open(call.where);
    open_ |= call.id == RequestId::kWorldBegin;
    interpreter_.request(call);
    if (call.id == RequestId::kOption) place_folders();
  }
  void unknown_request(std::string_view name, std::string_view suggestion, SourceRange where) override {
    interpreter_.unknown_request(name, suggestion, where);
  }

private:
  void open(SourceRange where) {
    render::RequestCall begin;
    begin.id = render::RequestId::kWorldBegin;
    begin.where = where;
    interpreter_.request(begin);
    open_ = true;
  }

  /// Relative folders of search paths are beside the test.
  void place_folders() const {
    for (auto& [kind, path] : interpreter_.options().search_paths)
      for (std::string& folder : path)
        if (!folder.starts_with('/') && !folder.starts_with(folder_)) folder = folder_ + folder;
  }

  render::Interpreter& interpreter_;
  std::string folder_; ///< "", or with a slash at the end
  bool open_ = false;
};

std::string folder_of(const std::vector<std::string>& path) {
  return path.empty() || path[0].empty() || path[0] == "." ? "" : path[0] + "/";
}

class RenderedScene final : public RayScene {
public:
  explicit RenderedScene(const RaySceneRequest& request)
      : cache_(*request.machine,
               [shader = request.shader](const std::string& name, const std::vector<std::string>& path) {
                 return shader(name, path);
               }) {
    SourceManager sources;
    Diagnostics diagnostics;
    render::Interpreter interpreter(sources, diagnostics,
                                    [&](render::Scene& scene) { scene_ = std::move(scene); });
    for (const char* kind : {"texture", "archive", "shader"})
      interpreter.options().search_paths[kind] = request.path;
    WorldOpener opener(interpreter, folder_of(request.path));
    auto read = [&](const std::string& text) {
      const FileId file = sources.add(request.name, text);
      render::parse_rib(sources.text(file), file, opener, diagnostics);
    };
    read("Projection \"perspective\" \"fov\" 60");
    read(request.rib + kLast);
    interpreter.finish();
    render::RayAttributes own;
    if (!scene_.primitives.empty()) {
      own = scene_.primitives.back().attributes().rays;
      scene_.primitives.pop_back();
    }
    render::TextureMaps::Settings settings;
    settings.folders = scene_.options.search_paths["texture"];
    textures_ = std::make_unique<render::TextureMaps>(settings);
    bound_ = std::make_unique<render::BoundShaders>(scene_, *request.machine, cache_, diagnostics);
    auto find = [path = settings.folders](std::string_view name) {
      return render::find_file(name, path).value_or(std::string(name));
    };
    lookups_ = std::make_unique<subsurface::CloudLookups>(clouds_, find);
    files_ = std::make_unique<subsurface::ReadClouds>(find);
    caches_ = std::make_unique<render::CacheFiles>(find);
    photons_ = std::make_unique<render::PhotonMaps>(find);
    services_ = std::make_unique<render::SceneServices>(scene_, *bound_, *textures_, *lookups_, *files_,
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
  bool option(const ShadingState& state, std::string_view name, Value& out) override {
    return services_->option(state, name, out);
  }
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
  std::unique_ptr<subsurface::ReadClouds> files_;
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
