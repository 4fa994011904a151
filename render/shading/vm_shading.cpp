// Shading by the virtual machine.
#include "render/shading/vm_shading.h"

#include "render/shading/default_surface.h"

namespace render {

namespace {

/// Where a surface sets Oi to 0 and leaves Ci as it started, at Cs, it means a hole ("if (outside) Oi = 0;"),
/// not light that is added to what lies behind.
void leave_out_holes(slvm::Grid& grid) {
  using slvm::Global;
  float* Ci = grid.varying(Global::kCi);
  const float* Oi = grid.varying(Global::kOi);
  const slvm::Planes& Cs = grid.variable(Global::kCs);
  const size_t pitch = grid.pitch();
  for (size_t i = 0; i < grid.points(); ++i) {
    if (Oi[i] != 0 || Oi[pitch + i] != 0 || Oi[2 * pitch + i] != 0) continue;
    if (Ci[i] != Cs.get(0, i) || Ci[pitch + i] != Cs.get(1, i) || Ci[2 * pitch + i] != Cs.get(2, i)) continue;
    for (size_t c = 0; c < 3; ++c)
      Ci[c * pitch + i] = 0;
  }
}

class VmGridShader : public GridShader {
public:
  VmGridShader(const slvm::Machine& machine, const BoundShaders& shaders, SceneServices& services)
      : shaders_(shaders), context_(machine, services) {}

  std::bitset<slvm::kGlobalCount> reads(const Primitive& primitive) const override {
    const BoundAttributes& bound = *shaders_.find(&primitive.attributes());
    return bound.shaders.displacement ? GridShader::reads(primitive) : bound.read;
  }

  bool displace(const Primitive& primitive, slvm::Grid& grid) override {
    // Once for each grid: a procedural made meanwhile may have the same shaders bound anew.
    set_ = shaders_.find(&primitive.attributes())->shaders;
    if (!set_.displacement) return false;
    context_.displace(set_, grid);
    return true;
  }

  void shade(const Primitive&, slvm::Grid& grid) override {
    const slvm::ShaderSet& set = set_;
    if (!set.surface) shade_by_default(grid);
    if (!set.surface && set.atmosphere)
      context_.run(*set.atmosphere, grid);
    else if (set.surface)
      context_.shade_displaced(set, grid);
    if (set.surface && !set.atmosphere) leave_out_holes(grid);
  }

  const slvm::Planes* output(const Primitive&, const slvm::Grid& grid, std::string_view name) override {
    for (const slvm::Instance* instance : {set_.surface, set_.displacement, set_.atmosphere})
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
  slvm::ShaderSet set_; ///< of the grid being shaded
};

} // namespace

std::unique_ptr<GridShader> VmShading::make_grid_shader() {
  return std::make_unique<VmGridShader>(machine_, shaders_, services_);
}

} // namespace render
