#include "render/texture/shadow_map.h"

#include <algorithm>

namespace render {
namespace {

// Steps of two low-discrepancy sequences: points that fill the square evenly, whatever their number.
constexpr float kGolden = 0.754877666f, kGoldenSquared = 0.569840291f;

/// The next number of a sequence in [0, 1), by a step below 1.
float next(float x, float step) {
  x += step;
  return x < 1 ? x : x - 1;
}

/// A coordinate of the region's points: linear in how far they are along its two sides.
struct Coordinate {
  float centre, along_u, along_v;

  Coordinate(const slvm::Matrix4& m, int column, const ShadowMap::Region& r)
      : centre(vector(m, column, r.centre) + m(3, column)), along_u(vector(m, column, r.along_u)),
        along_v(vector(m, column, r.along_v)) {}
  float at(float a, float b) const { return centre + a * along_u + b * along_v; }

private:
  static float vector(const slvm::Matrix4& m, int c, const float (&v)[3]) {
    return v[0] * m(0, c) + v[1] * m(1, c) + v[2] * m(2, c);
  }
};

} // namespace

float ShadowMap::shadowed(const Region& r) const {
  const Coordinate x(world_to_screen, 0, r), y(world_to_screen, 1, r), w(world_to_screen, 3, r),
      z(world_to_camera, 2, r);
  const auto columns = static_cast<float>(width), rows = static_cast<float>(height);
  // In front of the camera and inside the map only; elsewhere there is no shadow.
  auto hidden = [&](float a, float b) {
    const float at_w = w.at(a, b), at_z = z.at(a, b);
    if (!(at_w > 0) || !(at_z > 0)) return false;
    const float half = 0.5f / at_w, s = 0.5f + half * x.at(a, b) + a * r.sblur,
                t = 0.5f - half * y.at(a, b) + b * r.tblur;
    if (!(s >= 0 && s < 1 && t >= 0 && t < 1)) return false;
    const int i = std::min(static_cast<int>(s * columns), width - 1);
    const int j = std::min(static_cast<int>(t * rows), height - 1);
    return at_z > depth[static_cast<size_t>(j) * static_cast<size_t>(width) + static_cast<size_t>(i)] + r.bias;
  };
  auto wide = [](const float(&v)[3]) { return v[0] != 0 || v[1] != 0 || v[2] != 0; };
  const bool point = !wide(r.along_u) && !wide(r.along_v) && r.sblur == 0 && r.tblur == 0;
  if (point || r.samples <= 1) return hidden(0, 0) ? 1.0f : 0.0f;
  float a = static_cast<float>(r.seed & 0xffff) / 65536.0f, b = a;
  int count = 0;
  for (int i = 0; i < r.samples; ++i, a = next(a, kGolden), b = next(b, kGoldenSquared))
    count += hidden(a - 0.5f, b - 0.5f);
  return static_cast<float>(count) / static_cast<float>(r.samples);
}

} // namespace render
