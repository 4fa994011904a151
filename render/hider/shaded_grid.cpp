// Projection of grid points and culling of micropolygons.
#include "render/hider/shaded_grid.h"

#include <cmath>

namespace render {

namespace {

Vec3 read(const slvm::Planes& p, size_t k) {
  return {p.get(0, k), p.get(1, k), p.get(2, k)};
}

bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void hide_micropolygons(const slvm::Grid& grid, const Camera& camera, bool one_sided, ShadedGrid& out) {
  const slvm::Planes& P = grid.variable(slvm::Global::kP);
  auto nu = static_cast<size_t>(out.nu), nv = static_cast<size_t>(out.nv);
  float sign = grid.flip_normals ? -1.0f : 1.0f;
  float nearest = camera.perspective() ? camera.near_plane() : -kInfinity;
  out.hidden.assign((nu - 1) * (nv - 1), 0);
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      size_t k = j * nu + i;
      Vec3 p[4] = {read(P, k), read(P, k + 1), read(P, k + nu), read(P, k + nu + 1)};
      bool hidden = false;
      for (Vec3 q : p)
        hidden = hidden || !is_finite(q) || q.z < nearest;
      // The two diagonals span the plane of the micropolygon also where a side has collapsed.
      if (one_sided) {
        Vec3 normal = glm::cross(p[3] - p[0], p[2] - p[1]) * sign;
        hidden = hidden || glm::dot(normal, camera.incident((p[0] + p[3]) * 0.5f)) > 0;
      }
      out.hidden[m] = hidden;
    }
}

} // namespace

ShadedGrid make_shaded_grid(const Primitive& primitive, const slvm::Grid& grid, const Camera& camera,
                            const GridOutline* outline, std::span<const AovChannel> aovs,
                            GridShader& shader) {
  ShadedGrid out;
  const Attributes& a = primitive.attributes();
  out.nu = grid.nu();
  out.nv = grid.nv();
  out.matte = a.matte;
  out.smooth = a.smooth_shading;
  size_t points = grid.points();
  const slvm::Planes &P = grid.variable(slvm::Global::kP), &Ci = grid.variable(slvm::Global::kCi),
                     &Oi = grid.variable(slvm::Global::kOi);
  out.position.resize(points);
  out.Ci.resize(points);
  out.Oi.resize(points);
  for (size_t k = 0; k < points; ++k) {
    Vec3 p = read(P, k);
    out.position[k] = Vec3(camera.project(p), p.z);
    out.Ci[k] = read(Ci, k);
    out.Oi[k] = read(Oi, k);
    if (is_finite(out.Ci[k]) && is_finite(out.Oi[k])) continue;
    out.Ci[k] = Color(0.0f);
    out.Oi[k] = Color(1.0f);
    ++out.bad_colours;
  }
  for (const AovChannel& c : aovs)
    out.aov_floats += c.components;
  out.aov.assign(points * static_cast<size_t>(out.aov_floats), 0.0f);
  for (const AovChannel& c : aovs) {
    const slvm::Planes* planes = shader.output(primitive, grid, c.name);
    if (!planes || !planes->data) continue;
    int components = std::min(c.components, slvm::components(planes->type));
    for (size_t k = 0; k < points; ++k)
      for (int i = 0; i < components; ++i)
        out.aov[k * static_cast<size_t>(out.aov_floats) + static_cast<size_t>(c.first + i)] =
            planes->get(static_cast<size_t>(i), k);
  }
  hide_micropolygons(grid, camera, a.sides == 1, out);
  if (outline) snap_to_outline(*outline, out.nu, out.nv, out.position);
  return out;
}

} // namespace render
