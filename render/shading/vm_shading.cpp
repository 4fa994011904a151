// Shading by the virtual machine.
#include "render/shading/vm_shading.h"

#include "render/shading/default_surface.h"

namespace render {

namespace {

class VmGridShader : public GridShader {
public:
  VmGridShader(const slvm::Machine& machine, const BoundShaders& shaders, SceneServices& services)
      : shaders_(shaders), context_(machine, services) {}

  std::bitset<slvm::kGlobalCount> reads(const Primitive& primitive) const override {
    const BoundAttributes& bound = *shaders_.find(&primitive.attributes());
    return bound.shaders.displacement ? GridShader::reads(primitive) : bound.read;
  }

  PointNeeds needs(const Primitive& primitive) const override {
    return shaders_.find(&primitive.attributes())->points_need;
  }

  bool displace(const Primitive& primitive, slvm::Grid& grid) override {
    // Once for each grid: a procedural made meanwhile may have the same shaders bound anew.
    bound_ = shaders_.find(&primitive.attributes());
    if (!bound_->shaders.displacement) return false;
    context_.displace(bound_->shaders, grid);
    return true;
  }

  void shade(const Primitive&, slvm::Grid& grid) override {
    const slvm::ShaderSet& set = bound_->shaders;
    grid.neighbours_end = grid.lattice == slvm::Lattice::kHits && bound_->surface_differentiates_alone;
    if (!set.surface) shade_by_default(grid);
    if (!set.surface && set.atmosphere)
      context_.run(*set.atmosphere, grid);
    else if (set.surface)
      context_.shade_displaced(set, grid);
  }

  const slvm::Planes* output(const Primitive&, const slvm::Grid& grid, std::string_view name) override {
    const slvm::ShaderSet& set = bound_->shaders;
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
  const BoundShaders& shaders_;
  slvm::ShadingContext context_;
  const BoundAttributes* bound_ = nullptr; ///< of the grid being shaded
};

} // namespace

std::unique_ptr<GridShader> VmShading::make_grid_shader() {
  return std::make_unique<VmGridShader>(machine_, shaders_, services_);
}

} // namespace render
