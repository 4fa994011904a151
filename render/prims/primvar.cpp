// Interpolation of primitive variables.
#include "render/prims/primvar.h"

#include "render/prims/patches.h"

namespace render {

namespace {

std::array<float, 4> linear_weights(float t) {
  return {1 - t, t, 0, 0};
}

} // namespace

void interpolate(const PatchVar& var, std::span<const float> u, std::span<const float> v, float* out,
                 size_t pitch) {
  size_t width = var.width(), points = u.size() * v.size();
  if (var.interpolation == Interpolation::kConstant) {
    for (size_t c = 0; c < width; ++c)
      std::fill_n(out + c * pitch, points, var.values[c]);
    return;
  }
  if (var.interpolation == Interpolation::kSurface) {
    std::vector<float> value(width);
    size_t k = 0;
    for (float vj : v)
      for (float ui : u) {
        var.surface->evaluate(ui, vj, value);
        for (size_t c = 0; c < width; ++c)
          out[c * pitch + k] = value[c];
        ++k;
      }
    return;
  }
  bool cubic = var.interpolation == Interpolation::kBicubic;
  size_t side = cubic ? 4 : 2, k = 0;
  for (float vj : v) {
    auto wv = cubic ? bernstein(vj) : linear_weights(vj);
    for (float ui : u) {
      auto wu = cubic ? bernstein(ui) : linear_weights(ui);
      for (size_t c = 0; c < width; ++c) {
        float sum = 0;
        for (size_t j = 0; j < side; ++j)
          for (size_t i = 0; i < side; ++i)
            sum += wu[i] * wv[j] * var.values[(side * j + i) * width + c];
        out[c * pitch + k] = sum;
      }
      ++k;
    }
  }
}

} // namespace render
