// Primitive variables: per-corner values a primitive carries, interpolated to the points of a grid.
#pragma once

#include "render/prims/geometry.h"
#include "slvm/format/types.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace slvm {
class Grid;
class StringPool;
} // namespace slvm

namespace render {

enum class Interpolation : uint8_t {
  kConstant, ///< one value
  kBilinear, ///< at (0,0), (1,0), (0,1), (1,1)
  kBicubic,  ///< 16 Bezier values
  kSurface,  ///< by a basis of the geometry's own (NURBS, subdivision)
};

/// The values of a variable whose basis is the geometry's own.
class VarSurface {
public:
  virtual ~VarSurface() = default;
  /// All components at one point.
  virtual void evaluate(float u, float v, std::span<float> out) const = 0;
};

/// A variable of one surface patch. Geometric values are in object space; Cs, Os, N, s, t and st replace what
/// the attributes and the geometry give.
struct PatchVar {
  std::string name;
  slvm::Type type = slvm::Type::kFloat;
  uint32_t elements = 0;
  Interpolation interpolation = Interpolation::kConstant;
  std::vector<float> values; ///< value by value, each width() floats
  std::vector<std::string> strings;
  std::shared_ptr<const VarSurface> surface = nullptr; ///< kSurface

  size_t width() const { return static_cast<size_t>(slvm::components(type)) * (elements ? elements : 1); }
};

/// Values of `var` on a surface: component c of place k at out[c * pitch + k].
void interpolate(const PatchVar& var, const UvPoints& at, float* out, size_t pitch);

} // namespace render
