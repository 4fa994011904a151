// Ray scenes by their module.
#include "slvm/tools/sltest/module.h"
#include "slvm/tools/sltest/ray_scene.h"

namespace slvm::sltest {

std::unique_ptr<RayScene> make_ray_scene(const RaySceneRequest& request) {
  using Make = RayScene* (*)(const RaySceneRequest&);
  auto make = reinterpret_cast<Make>(module_function("sltest_make_ray_scene", "sltest_rays.so"));
  return std::unique_ptr<RayScene>(make ? make(request) : nullptr);
}

} // namespace slvm::sltest
