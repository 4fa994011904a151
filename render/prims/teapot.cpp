// The teapot. Rim, body, bottom and lid are turned profiles; handle and spout are halves and their mirror
// images.
#include "render/prims/teapot.h"

namespace render {

namespace {

using Patch = std::array<Vec3, 16>;

/// Newell's quarter circle: (1, 0), (1, k), (k, 1), (0, 1).
constexpr float kQuarter = 0.56f;

/// Radius and height, from top to bottom.
constexpr Vec2 kProfiles[6][4] = {
    {{1.4f, 2.4f}, {1.3375f, 2.53125f}, {1.4375f, 2.53125f}, {1.5f, 2.4f}}, // rim
    {{1.5f, 2.4f}, {1.75f, 1.875f}, {2, 1.35f}, {2, 0.9f}},                 // body
    {{2, 0.9f}, {2, 0.45f}, {1.5f, 0.225f}, {1.5f, 0.15f}},
    {{1.5f, 0.15f}, {1.5f, 0.075f}, {1.425f, 0}, {0, 0}},       // bottom
    {{0, 3.15f}, {0.8f, 3.15f}, {0, 2.7f}, {0.2f, 2.7f}},       // knob
    {{0.2f, 2.7f}, {0.4f, 2.55f}, {1.3f, 2.55f}, {1.3f, 2.4f}}, // lid
};

/// The half with y <= 0; each row of four goes round half a cross-section, in the plane y = 0, out, and back.
constexpr float kHalves[4][4][4][3] = {
    {{{-1.6f, 0, 2.025f}, {-1.6f, -0.3f, 2.025f}, {-1.5f, -0.3f, 2.25f}, {-1.5f, 0, 2.25f}}, // handle
     {{-2.3f, 0, 2.025f}, {-2.3f, -0.3f, 2.025f}, {-2.5f, -0.3f, 2.25f}, {-2.5f, 0, 2.25f}},
     {{-2.7f, 0, 2.025f}, {-2.7f, -0.3f, 2.025f}, {-3, -0.3f, 2.25f}, {-3, 0, 2.25f}},
     {{-2.7f, 0, 1.8f}, {-2.7f, -0.3f, 1.8f}, {-3, -0.3f, 1.8f}, {-3, 0, 1.8f}}},
    {{{-2.7f, 0, 1.8f}, {-2.7f, -0.3f, 1.8f}, {-3, -0.3f, 1.8f}, {-3, 0, 1.8f}},
     {{-2.7f, 0, 1.575f}, {-2.7f, -0.3f, 1.575f}, {-3, -0.3f, 1.35f}, {-3, 0, 1.35f}},
     {{-2.5f, 0, 1.125f}, {-2.5f, -0.3f, 1.125f}, {-2.65f, -0.3f, 0.9375f}, {-2.65f, 0, 0.9375f}},
     {{-2, 0, 0.9f}, {-2, -0.3f, 0.9f}, {-1.9f, -0.3f, 0.6f}, {-1.9f, 0, 0.6f}}},
    {{{1.7f, 0, 1.425f}, {1.7f, -0.66f, 1.425f}, {1.7f, -0.66f, 0.6f}, {1.7f, 0, 0.6f}}, // spout
     {{2.6f, 0, 1.425f}, {2.6f, -0.66f, 1.425f}, {3.1f, -0.66f, 0.825f}, {3.1f, 0, 0.825f}},
     {{2.3f, 0, 2.1f}, {2.3f, -0.25f, 2.1f}, {2.4f, -0.25f, 2.025f}, {2.4f, 0, 2.025f}},
     {{2.7f, 0, 2.4f}, {2.7f, -0.25f, 2.4f}, {3.3f, -0.25f, 2.4f}, {3.3f, 0, 2.4f}}},
    {{{2.7f, 0, 2.4f}, {2.7f, -0.25f, 2.4f}, {3.3f, -0.25f, 2.4f}, {3.3f, 0, 2.4f}},
     {{2.8f, 0, 2.475f}, {2.8f, -0.25f, 2.475f}, {3.525f, -0.25f, 2.49375f}, {3.525f, 0, 2.49375f}},
     {{2.9f, 0, 2.475f}, {2.9f, -0.15f, 2.475f}, {3.45f, -0.15f, 2.5125f}, {3.45f, 0, 2.5125f}},
     {{2.8f, 0, 2.4f}, {2.8f, -0.15f, 2.4f}, {3.2f, -0.15f, 2.4f}, {3.2f, 0, 2.4f}}},
};

/// Quarter `q` of a turned profile, clockwise seen from above.
Patch turned(const Vec2 (&profile)[4], int q) {
  constexpr Vec2 kCircle[4] = {{1, 0}, {1, -kQuarter}, {kQuarter, -1}, {0, -1}};
  Patch out;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) {
      Vec2 c = kCircle[i];
      for (int k = 0; k < q; ++k)
        c = {c.y, -c.x};
      out[4 * j + i] = {profile[j].x * c.x, profile[j].x * c.y, profile[j].y};
    }
  return out;
}

/// The half itself, or its mirror image with the rows reversed so that the outside stays outside.
Patch half(const float (&points)[4][4][3], bool mirrored) {
  Patch out;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) {
      const float* p = points[j][mirrored ? 3 - i : i];
      out[4 * j + i] = {p[0], mirrored ? -p[1] : p[1], p[2]};
    }
  return out;
}

} // namespace

std::vector<std::array<Vec3, 16>> teapot_patches() {
  std::vector<Patch> out;
  for (const auto& profile : kProfiles)
    for (int q = 0; q < 4; ++q)
      out.push_back(turned(profile, q));
  for (const auto& points : kHalves)
    for (bool mirrored : {false, true})
      out.push_back(half(points, mirrored));
  return out;
}

} // namespace render
