// A small scene around the grid, for shaders that shoot rays: RIB text, whose objects the renderer makes and
// traces. It is in a module of its own, because the renderer takes longer to load than most tests to run.
#pragma once

#include "slvm/machine.h"
#include "slvm/renderer_services.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace slvm::sltest {

struct RaySceneRequest {
  const Machine* machine = nullptr; ///< whose shaders ask; outlives the scene
  /// What stands between WorldBegin and WorldEnd, with options in front; "world" is "current".
  std::string rib;
  std::string name; ///< of the text, for messages
  /// Folders of textures, archives and shaders where Option "searchpath" does not say otherwise. Relative
  /// ones it names are in the first of them.
  std::vector<std::string> path;
  /// The bytes of a compiled shader by name, in these folders.
  std::function<Result<std::string>(const std::string& name, const std::vector<std::string>& path)> shader;
};

class RayScene {
public:
  virtual ~RayScene() = default;
  virtual RayServices& rays() = 0;
  /// What the scene's options say, defaults included; see RendererServices::option.
  virtual bool option(const ShadingState& state, std::string_view name, Value& out) = 0;
  /// Files are read; what is inserted is not written.
  virtual IrradianceCacheServices& irradiance_caches() = 0;
  virtual PhotonMapServices& photon_maps() = 0;
  /// What is wrong with the RIB, or "".
  virtual const std::string& problem() const = 0;
};

/// Null where the module is missing.
std::unique_ptr<RayScene> make_ray_scene(const RaySceneRequest& request);

} // namespace slvm::sltest
