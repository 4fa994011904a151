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

/// Which points of a surface are the ones below or above where rays met its faces: these may be off them, as
/// faces are off the surface, but not beside.
class NearnessTest {
public:
  explicit NearnessTest(const PrimitiveState& state)
      : m_(state.camera_to_object), affine_(is_affine(m_)), origin_(m_(3, 0), m_(3, 1), m_(3, 2)) {
    // The greatest factor by which lengths grow towards camera space is no more than this (Gershgorin, of the
    // squares); of rigid and even scalings it is it.
    const Matrix4& to_camera = state.object_to_camera;
    for (int i = 0; i < 3; ++i) {
      float row = 0;
      for (int j = 0; j < 3; ++j) {
        float sum = 0;
        for (int c = 0; c < 3; ++c)
          sum += to_camera(i, c) * to_camera(j, c);
        row += std::abs(sum);
      }
      squared_growth_ = std::max(squared_growth_, row);
    }
  }
  bool passes(const SurfaceLattice& lattice, size_t k, Vec3 target, float distance) const {
    const Vec3 there = affine_ ? transform_vector(m_, target) + origin_ : transform_point(m_, target);
    const Vec3 off = there - lattice.P[k], N = lattice.N[k];
    const float along = glm::dot(off, N), length = glm::dot(N, N), most = kNearEnough * distance;
    // |off|^2 without what lies along N.
    return (glm::dot(off, off) * length - along * along) * squared_growth_ <= most * most * length;
  }

private:
  const Matrix4& m_;
  bool affine_;
  Vec3 origin_;
  float squared_growth_ = 0;
};

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
  moved_.clear();
  runs_.clear();
  for (size_t i = 0; i < hits.size(); ++i) {
    const HitRay& hit = hits[i];
    const Primitive* p = &scene.primitives[hit.place.primitive];
    bool moves = hit.time > 0 && (!p->deformation.empty() || !p->state->motion.empty());
    if (i > 0 && hits[i - 1].place.primitive == hit.place.primitive &&
        (!moves || hits[i - 1].time == hit.time)) {
      ++runs_.back().count;
      continue;
    }
    if (moves) p = &moved_.emplace_back(primitive_at(*p, hit.time));
    runs_.push_back({p, i, 1, hit.place.displaced});
  }
}

/// Places of a run's hits (row 0) or of their neighbours.
UvPoints HitGrid::points(const Run& run, size_t row) const {
  size_t first = row * hits_ + run.first;
  return {std::span(u_).subspan(first, run.count), std::span(v_).subspan(first, run.count), true};
}

/// Appends a row to the lattice: of hits or of their neighbours.
void HitGrid::evaluate(size_t row) {
  for (const Run& run : runs_) {
    if (row == 0 && runs_.size() == 1) return run.primitive->geometry->evaluate(points(run, row), lattice_);
    run.primitive->geometry->evaluate(points(run, row), scratch_);
    lattice_.append(scratch_);
  }
}

/// Lists the hits of a run that are not where their rays are.
void HitGrid::find_open(const Run& run, std::span<const HitRay> hits) {
  open_.clear();
  if (run.displaced) return; // displaced faces tell nothing about the surface below
  const NearnessTest is_near(*run.primitive->state);
  for (size_t k = run.first; k < run.first + run.count; ++k)
    if (!is_near.passes(lattice_, k, targets_[k], hits[k].distance))
      open_.push_back(static_cast<uint32_t>(k));
}

/// Takes `open_` hits to the points of the surface that lie nearest to where their rays met the faces, which
/// are a little off the surface, and their parameters off its.
void HitGrid::settle(const Run& run, std::span<const HitRay> hits) {
  constexpr int kRounds = 6;
  const NearnessTest is_near(*run.primitive->state);
  const Matrix4& m = run.primitive->state->object_to_camera;
  for (int round = 0; round < kRounds && !open_.empty(); ++round) {
    next_u_.clear();
    next_v_.clear();
    std::erase_if(open_, [&](uint32_t k) {
      SurfaceSpot spot = in_camera(m, lattice_, k);
      Vec2 step = nearest_combination(spot.dPdu, spot.dPdv, targets_[k] - spot.P);
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
      const Vec3 target = targets_[k];
      if (glm::distance(transform_point(m, scratch_.P[i]), target) >
          glm::distance(transform_point(m, lattice_.P[k]), target))
        continue;
      u_[k] = next_u_[i];
      v_[k] = next_v_[i];
      copy_point(scratch_, i, lattice_, k);
      if (!is_near.passes(lattice_, k, target, hits[k].distance)) open_[kept++] = k;
    }
    open_.resize(kept);
  }
}

/// The footprint as two sides of a parallelogram becomes steps along u and along v, and its sides in these
/// steps.
void HitGrid::take_footprints(const HitRays& rays, std::span<const HitRay> hits) {
  size_t n = hits.size();
  for (auto& plane : footprint_)
    plane.resize(n);
  u_stretch_.resize(n);
  v_stretch_.resize(n);
  u_.resize(3 * n);
  v_.resize(3 * n);
  for (const Run& run : runs_)
    for (size_t i = run.first; i < run.first + run.count; ++i) {
      Footprint f =
          footprint_on(rays, hits[i], in_camera(run.primitive->state->object_to_camera, lattice_, i));
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

void HitGrid::dice(const Scene& scene, const HitRays& rays, std::span<const HitRay> hits, bool beside,
                   const DiceContext& context, const ReadVariables& read) {
  const size_t n = hits.size(), rows = beside ? 3 : 1;
  find_runs(scene, hits);
  u_.resize(n);
  v_.resize(n);
  origins_.resize(rows * n);
  targets_.resize(n);
  for (size_t i = 0; i < n; ++i) { // hits are in another order than their rays: these are read once
    u_[i] = hits[i].place.u;
    v_[i] = hits[i].place.v;
    origins_[i] = rays.origin(hits[i]);
    targets_[i] = origins_[i] + rays.direction(hits[i]) * hits[i].distance;
  }
  hits_ = n;
  lattice_.resize(0);
  evaluate(0);
  for (const Run& run : runs_) {
    find_open(run, hits);
    if (!open_.empty()) settle(run, hits);
  }
  grid.reset(static_cast<int>(n), static_cast<int>(rows));
  if (beside) {
    take_footprints(rays, hits);
    evaluate(1);
    evaluate(2);
  }
  parts_.clear();
  for (const Run& run : runs_)
    for (size_t row = 0; row < rows; ++row)
      parts_.push_back({run.primitive, points(run, row), row * n + run.first});
  ReadVariables diced = read;
  diced.predefined.reset(static_cast<size_t>(Global::kI)); // rays have their own
  if (beside) // steps are differences of these, which primitives may bring along
    for (Global g : {Global::ku, Global::kv})
      diced.predefined.set(static_cast<size_t>(g));
  dice_points(parts_, lattice_, context, diced, grid);
  // A primitive that was moved in time is this grid's only.
  grid.user = &scene.primitives[hits[0].place.primitive];
  grid.lattice = slvm::Lattice::kHits;
  grid.derivatives = beside;
  if (beside) {
    stretch(n);
    for (size_t c = 0; c < 4; ++c)
      grid.footprint[c] = footprint_[c].data();
  }
  set_steps(n);
  set_rays(rays, hits);
}

/// Brings the neighbours, which were evaluated at another distance, to where they belong.
void HitGrid::stretch(size_t n) {
  auto planes = [&](const slvm::Planes& p) {
    if (!p.data || !p.step || p.type == slvm::Type::kString) return;
    size_t count = static_cast<size_t>(slvm::components(p.type)) * (p.elements ? p.elements : 1);
    for (size_t c = 0; c < count; ++c) {
      float* x = p.data + c * p.pitch;
      for (size_t i = 0; i < n; ++i) {
        x[n + i] = x[i] + (x[n + i] - x[i]) * u_stretch_[i];
        x[2 * n + i] = x[i] + (x[2 * n + i] - x[i]) * v_stretch_[i];
      }
    }
  };
  for (int g = 0; g < slvm::kGlobalCount; ++g)
    planes(grid.variable(static_cast<Global>(g)));
  for (const auto& [name, p] : grid.primvars())
    planes(p);
}

void HitGrid::set_steps(size_t n) {
  if (!grid.derivatives) {
    for (Global g : {Global::kdu, Global::kdv})
      grid.set_uniform(g, {&kLeastStep, 1});
    return;
  }
  for (bool along_u : {true, false}) {
    const float* from = grid.variable(along_u ? Global::ku : Global::kv).data;
    float* to = grid.varying(along_u ? Global::kdu : Global::kdv);
    const float* beside = from + (along_u ? n : 2 * n);
    for (size_t i = 0; i < n; ++i) {
      const float step = beside[i] - from[i];
      to[i] = step != 0 ? step : kLeastStep;
    }
    for (size_t row : {1, 2})
      std::copy_n(to, n, to + row * n);
  }
}

/// I, from where each point's ray starts.
void HitGrid::aim() {
  const size_t pitch = grid.pitch();
  const float* P = grid.variable(Global::kP).data;
  float* I = grid.varying(Global::kI);
  for (size_t k = 0; k < grid.points(); ++k)
    set_point(I, pitch, k, plane_point(P, pitch, k) - origins_[k]);
}

/// I, E and weights. A neighbour has the origin of the ray that would hit it.
void HitGrid::set_rays(const HitRays& rays, std::span<const HitRay> hits) {
  size_t n = hits.size();
  for (size_t i = 0; i < n && grid.derivatives; ++i) {
    const HitRay& hit = hits[i];
    float ux = footprint_[0][i], vx = footprint_[1][i], uy = footprint_[2][i], vy = footprint_[3][i];
    float determinant = ux * vy - uy * vx;
    bool usable = rays.wide() && std::abs(determinant) > 1e-6f;
    // One step along u is so many along x and y, by the inverse of the footprint.
    auto origin = [&](float x, float y) {
      if (!usable) return origins_[i];
      Vec3 dx = rays.at(rays.batch.origin_du, hit), dy = rays.at(rays.batch.origin_dv, hit);
      return origins_[i] + (dx * x + dy * y) / determinant;
    };
    origins_[n + i] = origin(vy, -vx);
    origins_[2 * n + i] = origin(-uy, ux);
  }
  aim();
  float eye[3] = {origins_[0].x, origins_[0].y, origins_[0].z};
  grid.set_uniform(Global::kE, eye);
  for (int c = 0; c < 3 && !rays.weights.empty(); ++c) {
    auto& plane = weight_[static_cast<size_t>(c)];
    plane.resize(n);
    for (size_t i = 0; i < n; ++i)
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
  aim();
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
