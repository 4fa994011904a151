// Shading by the virtual machine: the Shading of real renders.
#pragma once

#include "render/shading/grid_shader.h"
#include "render/shading/services.h"

namespace render {

class VmShading : public Shading {
public:
  /// `shaders` and `services` belong to the scene about to be rendered; all three must outlive this.
  VmShading(const slvm::Machine& machine, const BoundShaders& shaders, SceneServices& services)
      : machine_(machine), shaders_(shaders), services_(services) {}
  std::unique_ptr<GridShader> make_grid_shader() override;
  bool has_effects(const Primitive& primitive) const override {
    return shaders_.find(&primitive.attributes())->has_effects;
  }
  slvm::StringPool& strings() override { return machine_.strings(); }

private:
  const slvm::Machine& machine_;
  const BoundShaders& shaders_;
  SceneServices& services_;
};

} // namespace render
