// A small scene around the grid, for shaders that shoot rays: RIB text, whose objects the renderer makes and
// traces. It is in a module of its own, because the renderer takes longer to load than most tests to run.
#pragma once

#include "slvm/machine.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace slvm::sltest {

struct RaySceneRequest {
  const Machine* machine = nullptr; ///< whose shaders ask; outlives the scene
  std::string rib;                  ///< what stands between WorldBegin and WorldEnd; "world" is "current"
  std::string name;                 ///< of the text, for messages
  std::vector<std::string> path;    ///< folders of textures and archives
  /// The bytes of a compiled shader by name.
  std::function<Result<std::string>(const std::string& name)> shader;
};

class RayScene {
public:
  virtual ~RayScene() = default;
  virtual RayServices& rays() = 0;
  /// Files are read; what is inserted is not written.
  virtual IrradianceCacheServices& irradiance_caches() = 0;
  virtual PhotonMapServices& photon_maps() = 0;
  /// What is wrong with the RIB, or "".
  virtual const std::string& problem() const = 0;
};

/// Null where the module is missing.
std::unique_ptr<RayScene> make_ray_scene(const RaySceneRequest& request);

} // namespace slvm::sltest
