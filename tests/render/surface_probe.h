// One point of one surface, for tests of primitives: positions, normals, variables; scenes of a line of RIB.
#pragma once

#include "tests/render/render_text.h"

#include <gtest/gtest.h>

namespace render::testing {

struct SurfacePoint {
  Vec3 P, N, dPdu, dPdv;
};

inline SurfacePoint at(const Geometry& g, float u, float v) {
  SurfaceLattice l;
  g.evaluate({{&u, 1}, {&v, 1}}, l);
  return {l.P[0], l.N[0], l.dPdu[0], l.dPdv[0]};
}
inline SurfacePoint at(const Primitive& p, float u, float v) {
  return at(*p.geometry, u, v);
}

/// The first component of a variable.
inline float value(const Primitive& p, std::string_view name, float u, float v) {
  for (const PatchVar& var : p.vars)
    if (var.name == name) {
      std::vector<float> out(var.width());
      interpolate(var, {{&u, 1}, {&v, 1}}, out.data(), 1);
      return out[0];
    }
  ADD_FAILURE() << "no variable " << name;
  return 0;
}

inline void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// The world of these requests, which cause no message.
inline Scene scene_of(const std::string& rib) {
  Rendered r = render_text("Format 4 4 1 WorldBegin " + rib + " WorldEnd");
  EXPECT_EQ(r.messages, "");
  return r.scene;
}

} // namespace render::testing
