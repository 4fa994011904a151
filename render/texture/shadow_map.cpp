#include "render/texture/shadow_map.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// Fractions of two low-discrepancy sequences: points that fill the square evenly, whatever their number.
constexpr float kGolden = 0.754877666f, kGoldenSquared = 0.569840291f;

float fraction(float x) {
  return x - std::floor(x);
}

} // namespace

// In front of the camera and inside the map only; elsewhere there is no shadow.
bool ShadowMap::in_shadow(const slvm::Matrix4& m, const float (&p)[3], float s_offset, float t_offset,
                          float bias) const {
  auto column = [&](const slvm::Matrix4& n, int c) {
    return p[0] * n(0, c) + p[1] * n(1, c) + p[2] * n(2, c) + n(3, c);
  };
  float w = column(m, 3), z = column(world_to_camera, 2);
  if (!(w > 0) || !(z > 0)) return false;
  float s = 0.5f + 0.5f * column(m, 0) / w + s_offset, t = 0.5f - 0.5f * column(m, 1) / w + t_offset;
  if (!(s >= 0 && s < 1 && t >= 0 && t < 1)) return false;
  int x = std::min(static_cast<int>(s * static_cast<float>(width)), width - 1);
  int y = std::min(static_cast<int>(t * static_cast<float>(height)), height - 1);
  float nearest = depth[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  return z > nearest + bias;
}

float ShadowMap::shadowed(const Region& r) const {
  auto wide = [](const float(&v)[3]) { return v[0] != 0 || v[1] != 0 || v[2] != 0; };
  bool point = !wide(r.along_u) && !wide(r.along_v) && r.sblur == 0 && r.tblur == 0;
  int samples = point ? 1 : std::max(r.samples, 1);
  float first = samples == 1 ? 0.5f : static_cast<float>(r.seed & 0xffff) / 65536.0f;
  int hidden = 0;
  for (int i = 0; i < samples; ++i) {
    float a = samples == 1 ? 0 : fraction(first + static_cast<float>(i) * kGolden) - 0.5f;
    float b = samples == 1 ? 0 : fraction(first + static_cast<float>(i) * kGoldenSquared) - 0.5f;
    float p[3];
    for (size_t c = 0; c < 3; ++c)
      p[c] = r.centre[c] + a * r.along_u[c] + b * r.along_v[c];
    hidden += in_shadow(world_to_screen, p, a * r.sblur, b * r.tblur, r.bias);
  }
  return static_cast<float>(hidden) / static_cast<float>(samples);
}

} // namespace render
