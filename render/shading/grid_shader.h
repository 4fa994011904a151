// The hider's view of shading: displace and shade one diced grid, run the imager on finished pixels.
// Implemented over the virtual machine in vm_shading.h; tests have simpler ones.
#pragma once

#include "render/prims/primitive.h"
#include "slvm/grid.h"
#include "slvm/support/string_pool.h"

#include <bitset>
#include <memory>
#include <string_view>

namespace render {

/// One thread's shading; a grid goes through displace, then shade, then output.
class GridShader {
public:
  virtual ~GridShader() = default;
  /// The predefined variables of grids that shading a primitive reads.
  virtual std::bitset<slvm::kGlobalCount> reads(const Primitive&) const {
    return std::bitset<slvm::kGlobalCount>().set();
  }
  /// Whether each point is shaded by itself, so that some can be left out; such primitives are not displaced.
  virtual bool point_by_point(const Primitive&) const { return false; }
  /// Begins a grid: runs the displacement shader. False: the primitive has none, and the grid is as it was.
  virtual bool displace(const Primitive&, slvm::Grid&) = 0;
  /// Sets Ci and Oi.
  virtual void shade(const Primitive&, slvm::Grid&) = 0;
  /// A variable of the grid just shaded, by name: predefined, primitive variable, or output of one of its
  /// shaders. Null: nothing has it.
  virtual const slvm::Planes* output(const Primitive&, const slvm::Grid&, std::string_view name) = 0;
  /// Runs the imager on pixels: P, Ci, Oi and alpha are set and the latter three may change.
  virtual void image(const ShaderRequest&, slvm::Grid&) = 0;
};

class Shading {
public:
  virtual ~Shading() = default;
  virtual std::unique_ptr<GridShader> make_grid_shader() = 0;
  /// Whether shading such a primitive does more than give colours, so that it is not left out for being
  /// small. Called from any thread.
  virtual bool has_effects(const Primitive&) const { return false; }
  virtual slvm::StringPool& strings() = 0;
};

} // namespace render
