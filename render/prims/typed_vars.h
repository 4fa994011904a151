// Primitive variables as they stand in a request, cut into those of single patches. hpoints lose their
// weight.
#pragma once

#include "render/prims/primvar.h"
#include "render/state/attributes.h"
#include "render/state/declaration.h"

#include <array>

namespace render {

inline bool interpolates(StorageClass c) {
  return c != StorageClass::kConstant && c != StorageClass::kUniform;
}

/// Name and type only.
PatchVar var_head(const TypedParam& source);
/// Appends value `index` of a source variable as floats for shaders.
void append_value(const TypedParam& source, size_t index, std::vector<float>& out);

/// Value `index` everywhere.
PatchVar constant_var(const TypedParam& source, size_t index);
/// The values of four corners.
PatchVar bilinear_var(const TypedParam& source, const std::array<size_t, 4>& indices);
/// Sixteen control values of two bases, u fastest.
PatchVar bicubic_var(const TypedParam& source, const std::array<size_t, 16>& indices,
                     const CubicBasis& ubasis, const CubicBasis& vbasis);

/// Whether a variable of this storage class replaces no predefined one: what VarSource::differs_by_piece()
/// asks for.
bool has_own(std::span<const TypedParam> vars, StorageClass storage);

/// The weights that "Pw" gives the points; empty: all are one.
std::vector<float> point_weights(std::span<const TypedParam> vars);

} // namespace render
