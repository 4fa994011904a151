// Variables of requests to variables of patches.
#include "render/prims/typed_vars.h"

#include "render/prims/dice.h"
#include "render/prims/patches.h"

#include <algorithm>

namespace render {

void append_value(const TypedParam& source, size_t index, std::vector<float>& out) {
  const Declaration& d = source.declaration;
  auto width = static_cast<size_t>(d.width());
  const float* from = source.numbers.data() + index * width;
  if (!d.hpoint) {
    out.insert(out.end(), from, from + width);
    return;
  }
  for (size_t i = 0; i < width; i += 4)
    for (size_t k = 0; k < 3; ++k)
      out.push_back(from[i + k] / from[i + 3]);
}

PatchVar var_head(const TypedParam& source) {
  PatchVar var;
  const Declaration& d = source.declaration;
  var.name = d.name == "Np" ? "N" : d.name;
  var.type = d.type;
  var.elements = d.elements;
  return var;
}

PatchVar constant_var(const TypedParam& source, size_t index) {
  PatchVar var = var_head(source);
  if (var.type == slvm::Type::kString) {
    auto width = static_cast<std::ptrdiff_t>(var.width());
    auto from = source.strings.begin() + static_cast<std::ptrdiff_t>(index) * width;
    var.strings.assign(from, from + width);
  } else {
    append_value(source, index, var.values);
  }
  return var;
}

PatchVar bilinear_var(const TypedParam& source, const std::array<size_t, 4>& indices) {
  PatchVar var = var_head(source);
  var.interpolation = Interpolation::kBilinear;
  for (size_t index : indices)
    append_value(source, index, var.values);
  return var;
}

PatchVar bicubic_var(const TypedParam& source, const std::array<size_t, 16>& indices,
                     const CubicBasis& ubasis, const CubicBasis& vbasis) {
  PatchVar var = var_head(source);
  var.interpolation = Interpolation::kBicubic;
  for (size_t index : indices)
    append_value(source, index, var.values);
  for (size_t c = 0, width = var.width(); c < width; ++c)
    convert_to_bezier(ubasis, vbasis, &var.values[c], width);
  return var;
}

bool has_own(std::span<const TypedParam> vars, StorageClass storage) {
  return std::any_of(vars.begin(), vars.end(), [&](const TypedParam& v) {
    return v.declaration.storage == storage && replaced_variable(var_head(v)) == slvm::Global::kCount;
  });
}

std::vector<float> point_weights(std::span<const TypedParam> vars) {
  std::vector<float> out;
  for (const TypedParam& v : vars)
    if (v.declaration.name == "Pw" && v.declaration.hpoint)
      for (size_t i = 3; i < v.numbers.size(); i += 4)
        out.push_back(v.numbers[i]);
  return out;
}

} // namespace render
