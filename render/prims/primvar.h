// Primitive variables: per-corner values a primitive carries, interpolated to the points of a grid.
#pragma once

#include "render/prims/geometry.h"
#include "slvm/format/types.h"

#include <cstdint>
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

  size_t width() const { return static_cast<size_t>(slvm::components(type)) * (elements ? elements : 1); }
};

/// Values of `var` on a lattice: component c of point k at out[c * pitch + k].
void interpolate(const PatchVar& var, std::span<const float> u, std::span<const float> v, float* out,
                 size_t pitch);

} // namespace render
