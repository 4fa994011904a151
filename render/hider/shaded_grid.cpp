// Projection of grid points and culling of micropolygons.
#include "render/hider/shaded_grid.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// A triple of a grid, by point.
class Triples {
public:
  explicit Triples(const slvm::Planes& p) : first_(p.data), pitch_(p.pitch), step_(p.step) {}
  Vec3 operator[](size_t k) const {
    const float* at = first_ + k * step_;
    return {at[0], at[pitch_], at[2 * pitch_]};
  }

private:
  const float* first_;
  size_t pitch_, step_;
};

bool is_finite(Vec3 v) {
  // Differences of what is not finite are no numbers.
  return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;
}

/// Calls `test` with the four corners of each micropolygon and marks those for which it is true.
template <class Test>
void hide_where(const slvm::Grid& grid, ShadedGrid& out, ShadedGrid::Visibility mark, Test&& test) {
  const Triples P(grid.variable(slvm::Global::kP));
  auto nu = static_cast<size_t>(out.nu), nv = static_cast<size_t>(out.nv);
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      size_t k = j * nu + i;
      Vec3 p[4] = {P[k], P[k + 1], P[k + nu], P[k + nu + 1]};
      if (test(p) && out.hidden[m] != ShadedGrid::kNotDrawn) out.hidden[m] = mark;
    }
}

void hide_between_pieces(const slvm::Grid& grid, ShadedGrid& out) {
  auto nu = static_cast<size_t>(out.nu), nv = static_cast<size_t>(out.nv);
  auto rows = static_cast<size_t>(grid.rows_of_piece());
  for (size_t j = rows - 1; j + 1 < nv; j += rows)
    std::fill_n(out.hidden.begin() + static_cast<std::ptrdiff_t>(j * (nu - 1)), nu - 1,
                ShadedGrid::kNotDrawn);
}

void hide_behind_eye(const slvm::Grid& grid, const Camera& camera, ShadedGrid& out) {
  float nearest = camera.perspective() ? camera.near_plane() : -kInfinity;
  // Of most grids nothing is.
  const Triples P(grid.variable(slvm::Global::kP));
  bool visible = true;
  for (size_t k = 0; k < grid.points(); ++k) {
    const Vec3 p = P[k];
    visible &= is_finite(p) && p.z >= nearest;
  }
  if (visible) return;
  hide_where(grid, out, ShadedGrid::kNotDrawn, [&](const Vec3(&p)[4]) {
    return std::any_of(p, p + 4, [&](Vec3 q) { return !is_finite(q) || q.z < nearest; });
  });
}

/// `tolerance`: degrees that a micropolygon may face away and still be drawn.
void hide_back_faces(const slvm::Grid& grid, const Camera& camera, float tolerance, ShadedGrid& out) {
  float sign = grid.flip_normals ? -1.0f : 1.0f, sine = std::sin(radians(tolerance));
  hide_where(grid, out, out.solid ? ShadedGrid::kFacesAway : ShadedGrid::kNotDrawn, [&](const Vec3(&p)[4]) {
    // The two diagonals span the plane of the micropolygon also where a side has collapsed.
    Vec3 normal = glm::cross(p[3] - p[0], p[2] - p[1]) * sign;
    Vec3 I = camera.incident((p[0] + p[3]) * 0.5f);
    float limit = sine > 0 ? sine * glm::length(normal) * glm::length(I) : 0;
    return glm::dot(normal, I) > limit;
  });
}

std::vector<RasterBounds> bounds_of_rows(const ShadedGrid& grid) {
  auto nu = static_cast<size_t>(grid.nu);
  std::vector<RasterBounds> out(static_cast<size_t>(grid.nv) - 1);
  for (size_t j = 0; j < out.size(); ++j)
    for (size_t k = j * nu; k < (j + 2) * nu; ++k)
      out[j].add(Vec2(grid.position[k]));
  return out;
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
  out.level = primitive.state->level;
  size_t points = grid.points();
  const Triples P(grid.variable(slvm::Global::kP)), Ci(grid.variable(slvm::Global::kCi)),
      Oi(grid.variable(slvm::Global::kOi));
  out.position.resize(points);
  out.Ci.resize(points);
  out.Oi.resize(points);
  for (size_t k = 0; k < points; ++k) {
    const Vec3 p = P[k], C = Ci[k], O = Oi[k];
    out.position[k] = Vec3(camera.project(p), p.z);
    out.Ci[k] = C;
    out.Oi[k] = O;
    if (is_finite(C) && is_finite(O)) continue;
    out.Ci[k] = Color(0.0f);
    out.Oi[k] = Color(1.0f);
    ++out.bad_colours;
  }
  out.opaque = std::all_of(out.Oi.begin(), out.Oi.end(), [](const Color& O) { return O == Color(1.0f); });
  for (const AovChannel& c : aovs)
    out.aov_floats += c.components;
  out.aov.assign(points * static_cast<size_t>(out.aov_floats), 0.0f);
  for (size_t v = 0; v < aovs.size(); ++v) {
    const AovChannel& c = aovs[v];
    if (c.source != AovChannel::Source::kVariable) continue;
    const slvm::Planes* planes = shader.output(primitive, grid, c.name);
    if (!planes || !planes->data) continue;
    if (v < 64) out.variables |= uint64_t{1} << v;
    int components = std::min(c.components, slvm::components(planes->type));
    for (size_t k = 0; k < points; ++k)
      for (int i = 0; i < components; ++i)
        out.aov[k * static_cast<size_t>(out.aov_floats) + static_cast<size_t>(c.first + i)] =
            planes->get(static_cast<size_t>(i), k);
  }
  out.solid = primitive.state->solid;
  out.solid_primitive = primitive.state->solid_primitive;
  out.hidden.assign(static_cast<size_t>(out.nu - 1) * static_cast<size_t>(out.nv - 1), ShadedGrid::kDrawn);
  hide_between_pieces(grid, out);
  hide_behind_eye(grid, camera, out);
  if (a.sides == 1) hide_back_faces(grid, camera, a.back_face_tolerance, out);
  if (outline) snap_to_outline(*outline, out.nu, out.nv, out.position);
  out.rows = bounds_of_rows(out);
  return out;
}

void add_positions(ShadedGrid& shaded, float time, const slvm::Grid& grid, const Camera& camera,
                   const GridOutline* outline) {
  const Triples P(grid.variable(slvm::Global::kP));
  if (shaded.times.empty()) shaded.times.push_back(0);
  shaded.rows.clear();
  shaded.times.push_back(time);
  std::vector<Vec3> moved(grid.points());
  for (size_t k = 0; k < moved.size(); ++k) {
    const Vec3 p = P[k];
    moved[k] = Vec3(camera.project(p), p.z);
  }
  hide_behind_eye(grid, camera, shaded);
  if (outline) snap_to_outline(*outline, shaded.nu, shaded.nv, moved);
  shaded.position.insert(shaded.position.end(), moved.begin(), moved.end());
}

} // namespace render
