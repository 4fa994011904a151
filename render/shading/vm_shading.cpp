// Shading by the virtual machine.
#include "render/shading/vm_shading.h"

#include "render/shading/default_surface.h"

namespace render {

namespace {

class VmGridShader : public GridShader {
public:
  VmGridShader(const slvm::Machine& machine, const BoundShaders& shaders, SceneServices& services)
      : shaders_(shaders), context_(machine, services) {}

  bool displace(const Primitive& primitive, slvm::Grid& grid) override {
    const slvm::ShaderSet& set = shader_set(primitive);
    if (!set.displacement) return false;
    context_.displace(set, grid);
    return true;
  }

  void shade(const Primitive& primitive, slvm::Grid& grid) override {
    const slvm::ShaderSet& set = shader_set(primitive);
    if (!set.surface) shade_by_default(grid);
    if (!set.surface && set.atmosphere)
      context_.run(*set.atmosphere, grid);
    else if (set.surface)
      context_.shade_displaced(set, grid);
  }

  const slvm::Planes* output(const Primitive& primitive, const slvm::Grid& grid,
                             std::string_view name) override {
    const slvm::ShaderSet& set = shader_set(primitive);
    for (const slvm::Instance* instance : {set.surface, set.displacement, set.atmosphere})
      if (instance)
        if (const slvm::Planes* planes = context_.output(*instance, name)) return planes;
    slvm::Global g = slvm::find_global(name);
    return g == slvm::Global::kCount ? grid.primvar(std::string(name)) : &grid.variable(g);
  }

  void image(const ShaderRequest& imager, slvm::Grid& grid) override {
    if (const slvm::Instance* instance = shaders_.find(imager)) context_.run(*instance, grid);
  }

private:
  const slvm::ShaderSet& shader_set(const Primitive& primitive) const {
    return shaders_.find(&primitive.attributes())->shaders;
  }

  const BoundShaders& shaders_;
  slvm::ShadingContext context_;
};

} // namespace

std::unique_ptr<GridShader> VmShading::make_grid_shader() {
  return std::make_unique<VmGridShader>(machine_, shaders_, services_);
}

} // namespace render
