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

/// Whether `test` is true of all values; one after another without a branch, for the compiler to use vectors.
template <class Test> bool all_of(const float* values, size_t count, Test&& test) {
  int failed = 0;
  for (size_t k = 0; k < count; ++k)
    failed |= !test(values[k]);
  return failed == 0;
}

bool all_finite(const float* values, size_t count) {
  return all_of(values, count, [](float v) { return v - v == 0; });
}

/// Raster x and y, camera z.
Vec3Planes project_all(const slvm::Grid& grid, const Camera& camera) {
  const slvm::Planes& P = grid.variable(slvm::Global::kP);
  Vec3Planes out(grid.points());
  const float *x = P.data, *y = x + P.pitch, *z = y + P.pitch;
  float* __restrict raster_x = out.plane(0), * __restrict raster_y = out.plane(1);
  for (size_t k = 0; k < out.size(); ++k) {
    const Vec2 at = camera.project({x[k], y[k], z[k]});
    raster_x[k] = at.x;
    raster_y[k] = at.y;
  }
  std::copy_n(z, out.size(), out.plane(2));
  return out;
}

void snap(const GridOutline& outline, const ShadedGrid& grid, Vec3Planes& position) {
  for (size_t c = 0; c < 3; ++c)
    snap_to_outline(outline, grid.nu, grid.nv, {position.plane(c), position.size()});
}

/// A component of a variable to `points` points; `some`: the variable has values of these alone.
void spread(const slvm::Planes& from, size_t component, size_t points, std::span<const uint32_t> some,
            float* to) {
  const float* values = from.data + component * from.pitch;
  if (from.step == 0)
    std::fill_n(to, points, *values);
  else if (some.empty())
    std::copy_n(values, points, to);
  else
    for (size_t k = 0; k < some.size(); ++k)
      to[some[k]] = values[k];
}

Vec3Planes colours(const slvm::Planes& from, size_t points, std::span<const uint32_t> some, float others) {
  Vec3Planes out = some.empty() ? Vec3Planes(points) : Vec3Planes(points, Color(others));
  for (size_t c = 0; c < 3; ++c)
    spread(from, c, points, some, out.plane(c));
  return out;
}

/// Colours that are not finite become black and opaque. Returns how many.
size_t mend_colours(Vec3Planes& Ci, Vec3Planes& Oi) {
  auto finite = [](const Vec3Planes& v) {
    return all_finite(v.plane(0), v.size()) && all_finite(v.plane(1), v.size()) &&
           all_finite(v.plane(2), v.size());
  };
  if (finite(Ci) && finite(Oi)) return 0;
  size_t bad = 0;
  for (size_t k = 0; k < Ci.size(); ++k) {
    if (is_finite(Ci[k]) && is_finite(Oi[k])) continue;
    Ci.set(k, Color(0.0f));
    Oi.set(k, Color(1.0f));
    ++bad;
  }
  return bad;
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
  const slvm::Planes& P = grid.variable(slvm::Global::kP);
  const size_t points = grid.points();
  const float *x = P.data, *y = x + P.pitch, *z = y + P.pitch;
  if (all_finite(x, points) && all_finite(y, points) && all_finite(z, points) &&
      all_of(z, points, [&](float v) { return v >= nearest; }))
    return;
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

/// In lanes, for the compiler to use vectors.
void find_range(const float* values, size_t count, float& least, float& most) {
  constexpr size_t kLanes = 8;
  float low[kLanes], high[kLanes];
  std::fill_n(low, kLanes, kInfinity);
  std::fill_n(high, kLanes, -kInfinity);
  size_t k = 0;
  for (; k + kLanes <= count; k += kLanes)
    for (size_t i = 0; i < kLanes; ++i) {
      low[i] = std::min(low[i], values[k + i]);
      high[i] = std::max(high[i], values[k + i]);
    }
  for (; k < count; ++k) {
    low[0] = std::min(low[0], values[k]);
    high[0] = std::max(high[0], values[k]);
  }
  least = *std::min_element(low, low + kLanes);
  most = *std::max_element(high, high + kLanes);
}

/// Makes room in the bounds of a grid's rows for its points at some time.
void add_to_rows(const Vec3Planes& position, ShadedGrid& grid) {
  const auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv);
  grid.rows.resize(nv - 1);
  for (size_t j = 0; j < nv; ++j) {
    RasterBounds points;
    find_range(position.plane(0) + j * nu, nu, points.min.x, points.max.x);
    find_range(position.plane(1) + j * nu, nu, points.min.y, points.max.y);
    // They belong to two rows of micropolygons.
    for (size_t row = j > 0 ? j - 1 : 0; row <= j && row < nv - 1; ++row) {
      grid.rows[row].add(points.min);
      grid.rows[row].add(points.max);
    }
  }
}

} // namespace

ShadedGrid make_grid_geometry(const Primitive& primitive, const slvm::Grid& grid, const Camera& camera,
                              const GridOutline* outline) {
  ShadedGrid out;
  const Attributes& a = primitive.attributes();
  out.nu = grid.nu();
  out.nv = grid.nv();
  out.matte = a.matte;
  out.smooth = a.smooth_shading;
  out.level = primitive.state->level;
  out.position = project_all(grid, camera);
  out.solid = primitive.state->solid;
  out.solid_primitive = primitive.state->solid_primitive;
  out.hidden.assign(static_cast<size_t>(out.nu - 1) * static_cast<size_t>(out.nv - 1), ShadedGrid::kDrawn);
  hide_between_pieces(grid, out);
  hide_behind_eye(grid, camera, out);
  if (a.sides == 1) hide_back_faces(grid, camera, a.back_face_tolerance, out);
  if (outline) snap(*outline, out, out.position);
  add_to_rows(out.position, out);
  return out;
}

void add_looks(ShadedGrid& out, const Primitive& primitive, const slvm::Grid& grid,
               std::span<const uint32_t> some, std::span<const AovChannel> aovs, GridShader& shader) {
  const size_t points = out.points();
  out.Ci = colours(grid.variable(slvm::Global::kCi), points, some, 0);
  out.Oi = colours(grid.variable(slvm::Global::kOi), points, some, 1);
  out.bad_colours = mend_colours(out.Ci, out.Oi);
  out.opaque = true;
  for (size_t c = 0; out.opaque && c < 3; ++c)
    out.opaque = all_of(out.Oi.plane(c), points, [](float v) { return v == 1; });
  for (const AovChannel& c : aovs)
    out.aov_floats += c.components;
  out.aov.assign(points * static_cast<size_t>(out.aov_floats), 0.0f);
  for (size_t v = 0; v < aovs.size(); ++v) {
    const AovChannel& c = aovs[v];
    if (c.source != AovChannel::Source::kVariable) continue;
    const slvm::Planes* planes = shader.output(primitive, grid, c.name);
    if (!planes || !planes->data) continue;
    if (v < 64) out.variables |= uint64_t{1} << v;
    const int components = std::min(c.components, slvm::components(planes->type));
    for (int i = 0; i < components; ++i)
      spread(*planes, static_cast<size_t>(i), points, some,
             out.aov.data() + static_cast<size_t>(c.first + i) * points);
  }
}

void add_positions(ShadedGrid& shaded, float time, const slvm::Grid& grid, const Camera& camera,
                   const GridOutline* outline) {
  if (shaded.times.empty()) shaded.times.push_back(0);
  shaded.times.push_back(time);
  hide_behind_eye(grid, camera, shaded);
  Vec3Planes& moved = shaded.later.emplace_back(project_all(grid, camera));
  if (outline) snap(*outline, shaded, moved);
  add_to_rows(moved, shaded);
}

} // namespace render
