// Dicing hits.
#include "render/rays/hit_grid.h"

#include "render/prims/motion.h"

#include <cmath>

namespace render {

namespace {

using slvm::Global;

/// The surface is evaluated this far from a hit, at least and at most, in its parameters; what is farther or
/// nearer is extrapolated.
constexpr float kLeastStep = 1.0f / 8192, kMostStep = 1.0f / 16;
/// How far from the ray a hit may be, by its distance: about half a pixel of a usual camera.
constexpr float kNearEnough = 3e-4f;
/// Footprints do not grow further at more grazing angles.
constexpr float kLeastCosine = 0.03f;

Vec3 plane_point(const float* planes, size_t pitch, size_t k) {
  return {planes[k], planes[pitch + k], planes[2 * pitch + k]};
}
void set_point(float* planes, size_t pitch, size_t k, Vec3 p) {
  for (int c = 0; c < 3; ++c)
    planes[static_cast<size_t>(c) * pitch + k] = p[c];
}

/// The (a, b) for which a x + b y is nearest to d.
Vec2 nearest_combination(Vec3 x, Vec3 y, Vec3 d) {
  float xx = glm::dot(x, x), xy = glm::dot(x, y), yy = glm::dot(y, y);
  float dx = glm::dot(d, x), dy = glm::dot(d, y), determinant = xx * yy - xy * xy;
  if (determinant > 1e-9f * xx * yy) return Vec2(dx * yy - dy * xy, dy * xx - dx * xy) / determinant;
  // A pole, or an edge fallen together: along the side that is left.
  if (xx >= yy) return {xx > 0 ? dx / xx : 0.0f, 0};
  return {0, dy / yy};
}

SurfaceSpot in_camera(const Matrix4& to_camera, const SurfaceLattice& lattice, size_t k) {
  return {transform_point(to_camera, lattice.P[k]), transform_vector(to_camera, lattice.dPdu[k]),
          transform_vector(to_camera, lattice.dPdv[k])};
}

/// Whether a point of a surface is below or above where a ray met its faces: not farther beside than `most`.
bool is_near(const SurfaceSpot& spot, Vec3 target, float most) {
  const Vec3 off = target - spot.P, N = glm::cross(spot.dPdu, spot.dPdv);
  const float along = glm::dot(off, N);
  return (glm::dot(off, off) - most * most) * glm::dot(N, N) <= along * along;
}

void copy_point(const SurfaceLattice& from, size_t i, SurfaceLattice& to, size_t k) {
  to.P.set(k, from.P[i]);
  to.dPdu.set(k, from.dPdu[i]);
  to.dPdv.set(k, from.dPdv[i]);
  to.N.set(k, from.N[i]);
}

/// A step from `at` within 0 to 1, in the direction there is more room in.
float step_inside(float at, float wanted) {
  float step = std::clamp(wanted, kLeastStep, kMostStep);
  return at + step <= 1 ? step : -step;
}

} // namespace

Footprint footprint_on(const HitRays& rays, const HitRay& hit, const SurfaceSpot& spot) {
  Vec3 normal = glm::cross(spot.dPdu, spot.dPdv), direction = rays.direction(hit);
  float length = glm::length(normal);
  if (!rays.wide() || !(length > 0)) return {};
  normal /= length;
  float cosine = glm::dot(direction, normal);
  if (std::abs(cosine) < kLeastCosine) cosine = std::copysign(kLeastCosine, cosine);
  auto on_surface = [&](Vec3 origin_change, Vec3 direction_change) {
    Vec3 d = origin_change + direction_change * hit.distance;
    d -= direction * (glm::dot(d, normal) / cosine);
    return nearest_combination(spot.dPdu, spot.dPdv, d);
  };
  const slvm::RayBatch& b = rays.batch;
  Vec2 x = on_surface(rays.at(b.origin_du, hit), rays.at(b.direction_du, hit)),
       y = on_surface(rays.at(b.origin_dv, hit), rays.at(b.direction_dv, hit));
  return {x.x, x.y, y.x, y.y};
}

void HitGrid::find_runs(const Scene& scene, std::span<const HitRay> hits) {
  primitives_.clear();
  primitives_.reserve(hits.size()); // runs point to them
  runs_.clear();
  first_ = scene.primitives[hits.front().place.primitive];
  for (size_t first = 0, end = 0; first < hits.size(); first = end) {
    const HitRay& hit = hits[first];
    Primitive p = scene.primitives[hit.place.primitive];
    const bool moves = !p.deformation.empty() || !p.state->motion.empty();
    for (end = first + 1; end < hits.size(); ++end)
      if (hits[end].place.primitive != hit.place.primitive || (moves && hits[end].time != hit.time)) break;
    if (moves && hit.time > 0) p = primitive_at(p, hit.time);
    runs_.push_back({&primitives_.emplace_back(std::move(p)), first, end - first, hit.place.displaced});
  }
}

/// Places of a run's hits (row 0) or of their neighbours.
UvPoints HitGrid::points(const Run& run, size_t row) const {
  size_t first = row * hits_ + run.first;
  return {std::span(u_).subspan(first, run.count), std::span(v_).subspan(first, run.count), true};
}

/// The hits' origins, and where they met the faces. They are in another order than their rays: these are read
/// once.
void HitGrid::take_rays(const HitRays& rays, std::span<const HitRay> hits) {
  const size_t n = hits.size();
  u_.resize(n);
  v_.resize(n);
  distances_.resize(n);
  origins_.resize(n);
  targets_.resize(n);
  for (size_t i = 0; i < n; ++i) {
    u_[i] = hits[i].place.u;
    v_[i] = hits[i].place.v;
    distances_[i] = hits[i].distance;
    origins_.set(i, rays.origin(hits[i]));
    targets_.set(i, rays.direction(hits[i]));
  }
  for (size_t c = 0; c < 3; ++c) {
    const float *from = origins_.planes[c].data(), *distance = distances_.data();
    float* to = targets_.planes[c].data();
    for (size_t i = 0; i < n; ++i)
      to[i] = from[i] + to[i] * distance[i];
  }
}

/// Appends a row to the lattice: of hits or of their neighbours.
void HitGrid::evaluate(size_t row) {
  if (row == 0 && runs_.size() == 1)
    return runs_[0].primitive->geometry->evaluate(points(runs_[0], row), lattice_);
  if (row == 0) lattice_.resize(0);
  for (const Run& run : runs_) {
    run.primitive->geometry->evaluate(points(run, row), scratch_);
    lattice_.append(scratch_);
  }
}

/// P and what belongs to it, from the lattice.
void HitGrid::dice_run(const Run& run, const ReadVariables& read) {
  const SurfacePoints part{run.primitive, points(run, 0), run.first};
  dice_geometry({&part, 1}, lattice_, read, grid);
}

/// Lists the hits of a run that are not where their rays are: beside, that is, for faces are off the surface.
void HitGrid::find_open(const Run& run) {
  open_.clear();
  if (run.displaced) return; // displaced faces tell nothing about the surface below
  const size_t pitch = grid.pitch(), first = run.first;
  const float *P = grid.variable(Global::kP).data + first, *N = grid.variable(Global::kN).data + first,
              *distance = distances_.data() + first;
  const float* T[3];
  for (size_t c = 0; c < 3; ++c)
    T[c] = targets_.planes[c].data() + first;
  off_.resize(run.count);
  float* __restrict off = off_.data();
  for (size_t k = 0; k < run.count; ++k) {
    const float x = T[0][k] - P[k], y = T[1][k] - P[pitch + k], z = T[2][k] - P[2 * pitch + k];
    const float nx = N[k], ny = N[pitch + k], nz = N[2 * pitch + k];
    const float along = x * nx + y * ny + z * nz, length = nx * nx + ny * ny + nz * nz,
                most = kNearEnough * distance[k];
    // |off|^2 without what lies along N.
    off[k] = (x * x + y * y + z * z - most * most) * length - along * along;
  }
  for (size_t k = 0; k < run.count; ++k)
    if (!(off[k] <= 0)) open_.push_back(static_cast<uint32_t>(first + k));
}

/// Takes `open_` hits to the points of the surface that lie nearest to where their rays met the faces, which
/// are a little off the surface, and their parameters off its.
void HitGrid::settle(const Run& run, std::span<const HitRay> hits) {
  constexpr int kRounds = 6;
  const Matrix4& m = run.primitive->state->object_to_camera;
  for (int round = 0; round < kRounds && !open_.empty(); ++round) {
    next_u_.clear();
    next_v_.clear();
    std::erase_if(open_, [&](uint32_t k) {
      SurfaceSpot spot = in_camera(m, lattice_, k);
      Vec2 step = nearest_combination(spot.dPdu, spot.dPdv, targets_.get(k) - spot.P);
      float longest = std::max(std::abs(step.x), std::abs(step.y));
      if (!(longest < kInfinity)) return true;
      if (longest > 0.5f) step *= 0.5f / longest;
      float u = std::clamp(u_[k] + step.x, 0.0f, 1.0f), v = std::clamp(v_[k] + step.y, 0.0f, 1.0f);
      if (std::abs(u - u_[k]) + std::abs(v - v_[k]) < 1e-6f) return true;
      next_u_.push_back(u);
      next_v_.push_back(v);
      return false;
    });
    if (open_.empty()) return;
    run.primitive->geometry->evaluate({next_u_, next_v_, true}, scratch_);
    size_t kept = 0;
    for (size_t i = 0; i < open_.size(); ++i) {
      uint32_t k = open_[i];
      const Vec3 target = targets_.get(k);
      if (glm::distance(transform_point(m, scratch_.P[i]), target) >
          glm::distance(transform_point(m, lattice_.P[k]), target))
        continue;
      u_[k] = next_u_[i];
      v_[k] = next_v_[i];
      copy_point(scratch_, i, lattice_, k);
      if (!is_near(in_camera(m, lattice_, k), target, kNearEnough * hits[k].distance)) open_[kept++] = k;
    }
    open_.resize(kept);
  }
}

/// The footprint as two sides of a parallelogram becomes steps along u and along v, and its sides in these
/// steps.
void HitGrid::find_footprints(const HitRays& rays, std::span<const HitRay> hits) {
  const size_t n = hits_, pitch = grid.pitch();
  for (auto& plane : footprint_)
    plane.resize(n);
  u_stretch_.resize(n);
  v_stretch_.resize(n);
  u_.resize(3 * n);
  v_.resize(3 * n);
  const float *P = grid.variable(Global::kP).data, *dPdu = grid.variable(Global::kdPdu).data,
              *dPdv = grid.variable(Global::kdPdv).data;
  for (const Run& run : runs_) {
    const UvRect& whole = run.primitive->uv;
    const float width_u = whole.u1 - whole.u0, width_v = whole.v1 - whole.v0;
    for (size_t i = run.first; i < run.first + run.count; ++i) {
      const Footprint f = footprint_on(rays, hits[i],
                                       {plane_point(P, pitch, i), plane_point(dPdu, pitch, i) * width_u,
                                        plane_point(dPdv, pitch, i) * width_v});
      float along_u = std::sqrt(f.ux * f.ux + f.uy * f.uy), along_v = std::sqrt(f.vx * f.vx + f.vy * f.vy);
      // A ray that has no width in a direction still has derivatives there.
      float step_u = along_u > 1e-9f ? along_u : kLeastStep, step_v = along_v > 1e-9f ? along_v : kLeastStep;
      float sides[4] = {f.ux / step_u, f.vx / step_v, f.uy / step_u, f.vy / step_v};
      for (size_t c = 0; c < 4; ++c)
        footprint_[c][i] = sides[c];
      float du = step_inside(u_[i], step_u), dv = step_inside(v_[i], step_v);
      u_[n + i] = u_[i] + du;
      v_[n + i] = v_[i];
      u_[2 * n + i] = u_[i];
      v_[2 * n + i] = v_[i] + dv;
      u_stretch_[i] = step_u / du;
      v_stretch_[i] = step_v / dv;
    }
  }
  for (size_t c = 0; c < 4; ++c)
    grid.footprint[c] = footprint_[c].data();
}

namespace {

/// Which of the variables that the geometry decides are worth evaluating it at neighbours for: P follows from
/// tangents.
bool needs_surface_beside(const ReadVariables& read) {
  return read.has_beside(Global::kN) || read.has_beside(Global::kNg) || read.has_beside(Global::kdPdu) ||
         read.has_beside(Global::kdPdv);
}

} // namespace

/// Geometry and variables of the neighbours that are evaluated on the surface; those of parts_ that are
/// `beside`.
void HitGrid::dice_beside(const ReadVariables& read) {
  for (const Run& run : runs_)
    for (size_t row : {1, 2})
      parts_.push_back({run.primitive, points(run, row), row * hits_ + run.first, true});
  if (!needs_surface_beside(read)) return;
  evaluate(1);
  evaluate(2);
  dice_geometry(std::span(parts_).subspan(runs_.size()), lattice_, read, grid);
}

void HitGrid::dice(const Scene& scene, const HitRays& rays, std::span<const HitRay> hits, bool beside,
                   const DiceContext& context, const ReadVariables& read) {
  hits_ = hits.size();
  ReadVariables diced = read;
  if (beside) // steps are along tangents, and differences of parameters, which primitives may bring along
    for (Global g : {Global::ku, Global::kv, Global::kdPdu, Global::kdPdv})
      diced.predefined.set(static_cast<size_t>(g));
  grid.reset(static_cast<int>(hits_), beside ? 3 : 1);
  grid.lattice = slvm::Lattice::kHits;
  grid.derivatives = beside;
  find_runs(scene, hits);
  take_rays(rays, hits);
  evaluate(0);
  parts_.clear();
  for (const Run& run : runs_) {
    dice_run(run, diced);
    find_open(run);
    if (!open_.empty()) {
      settle(run, hits);
      dice_run(run, diced);
    }
    parts_.push_back({run.primitive, points(run, 0), run.first});
  }
  if (beside) {
    find_footprints(rays, hits);
    for (size_t i = 0; i < runs_.size(); ++i) // u_ and v_ have grown
      parts_[i].at = points(runs_[i], 0);
    dice_beside(diced);
  }
  dice_variables(parts_, context, diced, grid);
  grid.user = &first_; // its state is that of the scene, not moved in time
  if (beside) {
    stretch(read);
    step_along_tangents();
  }
  set_steps();
  set_rays(rays, hits, read);
}

/// Brings the neighbours, which were evaluated at another distance, to where they belong.
void HitGrid::stretch(const ReadVariables& read) {
  const size_t n = hits_;
  auto planes = [&](const slvm::Planes& p) {
    if (!p.data || !p.step || p.type == slvm::Type::kString) return;
    size_t count = static_cast<size_t>(slvm::components(p.type)) * (p.elements ? p.elements : 1);
    for (size_t c = 0; c < count; ++c) {
      const float* x = p.data + c * p.pitch;
      float *beside_u = p.data + c * p.pitch + n, *beside_v = beside_u + n;
      for (size_t i = 0; i < n; ++i) {
        beside_u[i] = x[i] + (beside_u[i] - x[i]) * u_stretch_[i];
        beside_v[i] = x[i] + (beside_v[i] - x[i]) * v_stretch_[i];
      }
    }
  };
  for (int g = 0; g < slvm::kGlobalCount; ++g) {
    const auto global = static_cast<Global>(g);
    const bool parameter = global == Global::ku || global == Global::kv; // their steps are asked for, too
    if (global != Global::kP && (parameter || read.has_beside(global))) planes(grid.variable(global));
  }
  for (const auto& [name, p] : grid.primvars())
    if (!read.of_primitives_beside || read.of_primitives_beside(name)) planes(p);
}

void HitGrid::step_along_tangents() {
  const size_t n = hits_, pitch = grid.pitch();
  float* P = grid.varying(Global::kP);
  for (const Run& run : runs_) {
    const UvRect& whole = run.primitive->uv;
    auto step = [&](Global tangent, float width, const std::vector<float>& at, const float* stretch,
                    size_t row) {
      const float *T = grid.variable(tangent).data, *from = at.data(), *to = from + row;
      for (size_t c = 0; c < 3; ++c)
        for (size_t i = run.first; i < run.first + run.count; ++i)
          P[c * pitch + row + i] =
              P[c * pitch + i] + T[c * pitch + i] * (width * stretch[i] * (to[i] - from[i]));
    };
    step(Global::kdPdu, whole.u1 - whole.u0, u_, u_stretch_.data(), n);
    step(Global::kdPdv, whole.v1 - whole.v0, v_, v_stretch_.data(), 2 * n);
  }
}

void HitGrid::set_steps() {
  if (!grid.derivatives) {
    for (Global g : {Global::kdu, Global::kdv})
      grid.set_uniform(g, {&kLeastStep, 1});
    return;
  }
  const size_t n = hits_;
  for (bool along_u : {true, false}) {
    const float* from = grid.variable(along_u ? Global::ku : Global::kv).data;
    float* to = grid.to_fill(along_u ? Global::kdu : Global::kdv);
    const float* beside = from + (along_u ? n : 2 * n);
    for (size_t i = 0; i < n; ++i) {
      const float step = beside[i] - from[i];
      to[i] = step != 0 ? step : kLeastStep;
    }
    for (size_t row : {1, 2})
      std::copy_n(to, n, to + row * n);
  }
}

/// I of the first points, from where their rays start.
void HitGrid::aim(size_t points) {
  const size_t pitch = grid.pitch();
  for (size_t c = 0; c < 3; ++c) {
    const float *P = grid.variable(Global::kP).data + c * pitch, *from = origins_.planes[c].data();
    float* I = grid.to_fill(Global::kI) + c * pitch;
    for (size_t k = 0; k < points; ++k)
      I[k] = P[k] - from[k];
  }
}

/// A neighbour has the origin of the ray that would hit it.
void HitGrid::find_origins(const HitRays& rays, std::span<const HitRay> hits) {
  const size_t n = hits_;
  origins_.resize(3 * n);
  for (size_t i = 0; i < n; ++i) {
    const HitRay& hit = hits[i];
    float ux = footprint_[0][i], vx = footprint_[1][i], uy = footprint_[2][i], vy = footprint_[3][i];
    float determinant = ux * vy - uy * vx;
    bool usable = rays.wide() && std::abs(determinant) > 1e-6f;
    // One step along u is so many along x and y, by the inverse of the footprint.
    auto origin = [&](float x, float y) {
      if (!usable) return origins_.get(i);
      Vec3 dx = rays.at(rays.batch.origin_du, hit), dy = rays.at(rays.batch.origin_dv, hit);
      return origins_.get(i) + (dx * x + dy * y) / determinant;
    };
    origins_.set(n + i, origin(vy, -vx));
    origins_.set(2 * n + i, origin(-uy, ux));
  }
}

/// I, E and weights.
void HitGrid::set_rays(const HitRays& rays, std::span<const HitRay> hits, const ReadVariables& read) {
  const bool beside = grid.derivatives && read.has_beside(Global::kI);
  if (beside) find_origins(rays, hits);
  aim(beside ? grid.points() : hits_);
  const Vec3 from = origins_.get(0);
  const float eye[3] = {from.x, from.y, from.z};
  grid.set_uniform(Global::kE, eye);
  for (int c = 0; c < 3 && !rays.weights.empty(); ++c) {
    auto& plane = weight_[static_cast<size_t>(c)];
    plane.resize(hits_);
    for (size_t i = 0; i < hits_; ++i)
      plane[i] = rays.weights[hits[i].ray][c];
    grid.ray.weight[c] = plane.data();
  }
}

void HitGrid::before_displacement() {
  const float* P = grid.varying(Global::kP);
  saved_.assign(P, P + 3 * grid.pitch());
}

void HitGrid::after_displacement(bool moved) {
  float* P = grid.varying(Global::kP);
  if (!moved) {
    std::copy(saved_.begin(), saved_.end(), P);
    return;
  }
  size_t n = grid.samples(), pitch = grid.pitch();
  float *dPdu = grid.varying(Global::kdPdu), *dPdv = grid.varying(Global::kdPdv),
        *Ng = grid.varying(Global::kNg);
  const slvm::Planes du = grid.variable(Global::kdu), dv = grid.variable(Global::kdv);
  float sign = grid.flip_normals ? -1.0f : 1.0f;
  aim(grid.points());
  for (size_t k = 0; k < grid.points() && grid.derivatives; ++k) {
    size_t i = k % n;
    Vec3 at = plane_point(P, pitch, i);
    Vec3 along_u = (plane_point(P, pitch, n + i) - at) / du.data[i];
    Vec3 along_v = (plane_point(P, pitch, 2 * n + i) - at) / dv.data[i];
    set_point(dPdu, pitch, k, along_u);
    set_point(dPdv, pitch, k, along_v);
    Vec3 normal = glm::cross(along_u, along_v) * sign;
    if (glm::dot(normal, normal) > 0) set_point(Ng, pitch, k, normal);
  }
}

} // namespace render
