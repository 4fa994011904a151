// Interpolation of primitive variables.
#include "render/prims/primvar.h"

#include "render/prims/patches.h"

namespace render {

namespace {

std::array<float, 4> linear_weights(float t) {
  return {1 - t, t, 0, 0};
}

} // namespace

void interpolate(const PatchVar& var, const UvPoints& at, float* out, size_t pitch) {
  size_t width = var.width();
  if (var.interpolation == Interpolation::kConstant) {
    for (size_t c = 0; c < width; ++c)
      std::fill_n(out + c * pitch, at.size(), var.values[c]);
    return;
  }
  if (var.interpolation == Interpolation::kSurface) {
    std::vector<float> value(width);
    at.for_each([&](size_t k, float u, float v) {
      var.surface->evaluate(u, v, value);
      for (size_t c = 0; c < width; ++c)
        out[c * pitch + k] = value[c];
    });
    return;
  }
  bool cubic = var.interpolation == Interpolation::kBicubic;
  size_t side = cubic ? 4 : 2;
  auto weights = [&](float t) { return cubic ? bernstein(t) : linear_weights(t); };
  at.for_each(weights, weights, [&](size_t k, const auto& wu, const auto& wv) {
    for (size_t c = 0; c < width; ++c) {
      float sum = 0;
      for (size_t j = 0; j < side; ++j)
        for (size_t i = 0; i < side; ++i)
          sum += wu[i] * wv[j] * var.values[(side * j + i) * width + c];
      out[c * pitch + k] = sum;
    }
  });
}

} // namespace render
