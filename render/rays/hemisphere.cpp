// hemisphere(): the surroundings of the points of a grid, at each point by rays or interpolated between few
// of them, and what is kept of them in files.
#include "render/rays/hemisphere_cache.h"
#include "render/rays/hemisphere_file.h"
#include "render/rays/hemisphere_lattice.h"
#include "render/rays/hemisphere_records.h"
#include "render/rays/hemisphere_sampler.h"

#include <cmath>

namespace render {

namespace {

Vec3 vector_at(const float* const (&planes)[3], size_t i) {
  return planes[0] ? Vec3(planes[0][i], planes[1][i], planes[2][i]) : Vec3(0.0f);
}

bool is_on(const slvm::HemisphereQuery& q, size_t i) {
  return !q.mask || (q.mask[i / 64] >> (i % 64) & 1) != 0;
}

HemispherePoint point_of(const slvm::HemisphereQuery& q, size_t i) {
  HemispherePoint p;
  p.P = vector_at(q.position, i);
  p.N = vector_at(q.normal, i);
  p.along_u = vector_at(q.along_u, i);
  p.along_v = vector_at(q.along_v, i);
  if (q.cone_angle) p.cone = q.cone_angle[i];
  if (q.max_distance) p.max_distance = q.max_distance[i];
  if (q.bias) p.bias = q.bias[i];
  if (q.sample_base) p.base = q.sample_base[i];
  p.number = static_cast<uint32_t>(i);
  return p;
}

void store(const slvm::HemisphereQuery& q, size_t i, const HemisphereSample& s) {
  if (q.occlusion) q.occlusion[i] = s.value[0];
  Vec3 direction(s.value[7], s.value[8], s.value[9]);
  float length = glm::length(direction);
  if (length > 0) direction /= length;
  for (int c = 0; c < 3; ++c) {
    if (q.radiance[c]) q.radiance[c][i] = s.value[static_cast<size_t>(1 + c)];
    if (q.environment_colour[c]) q.environment_colour[c][i] = s.value[static_cast<size_t>(4 + c)];
    if (q.environment_direction[c]) q.environment_direction[c][i] = direction[c];
  }
}

bool is_usable(const HemispherePoint& p) {
  return std::isfinite(p.P.x + p.P.y + p.P.z + p.N.x + p.N.y + p.N.z) && glm::dot(p.N, p.N) > 0.5f;
}

} // namespace

/// The points of a query one after the other, from samples or between them.
class RayTracer::HemisphereRun {
public:
  HemisphereRun(RayTracer& tracer, const slvm::ShadingState& state, const slvm::HemisphereQuery& query)
      : tracer_(tracer), state_(state), grid_(state.grid), query_(query),
        attributes_(tracer.attributes_of(grid_)),
        max_error_(query.max_error >= 0 ? query.max_error : attributes_.max_error),
        most_pixels_(query.max_pixel_distance >= 0 ? query.max_pixel_distance
                                                   : attributes_.max_pixel_distance),
        whole_(query.points == grid_.points()),
        // Of hits only those that count.
        asked_(whole_ ? std::min(query.points, grid_.samples()) : query.points),
        sampler_(tracer, state, query, max_error_ > 0 && whole_),
        file_(tracer.cache_files_, state, query, tracer.services_, attributes_),
        mask_(query.points / 64 + 1) {}

  std::string run() {
    check_space();
    if (file_.is_all())
      take_from_file();
    else
      shoot();
    file_.finish();
    if (!sampler_.problem().empty()) return sampler_.problem();
    return file_.problem().empty() ? space_problem_ : file_.problem();
  }

private:
  /// Smaller grids are too small to be interpolated in themselves.
  static constexpr size_t kFewestOfLattice = 64;
  /// Samples that reach so many pixels for each time they are taken are taken again, as long as all their
  /// rays together are no more than so many.
  static constexpr float kPixelsAPass = 7, kMostPasses = 4, kRaysOfPasses = 256;

  void take_from_file() {
    for (size_t i = 0; i < asked_; ++i) {
      if (!is_on(query_, i)) continue;
      const HemispherePoint p = point_of(query_, i);
      const auto found = is_usable(p) ? file_.find(p, max_error_) : std::nullopt;
      store_all(i, found.value_or(HemisphereSample()));
    }
  }

  void shoot() {
    const bool interpolates = max_error_ > 0 && whole_;
    for (size_t i = 0; i < asked_; ++i) {
      HemispherePoint p = point_of(query_, i);
      if (interpolates && p.base > 0) take_pixel(p);
      bool wanted = is_on(query_, i) && is_usable(p) && sampler_.may_shoot() && sampler_.is_heavy_enough(i);
      if (wanted) mask_[i / 64] |= uint64_t{1} << (i % 64);
      if (is_on(query_, i) && !wanted) store(query_, i, {});
      points_.push_back(p);
    }
    if (!sampler_.may_shoot()) return;
    // What is in a file depends on nothing but the scene: there, small grids are lattices, too.
    const bool lattice = grid_.lattice == slvm::Lattice::kRows && grid_.nu() > 1 && grid_.nv() > 1;
    if (!interpolates)
      sample_all();
    else if (lattice && (grid_.points() >= kFewestOfLattice || file_.writes()))
      fill_between();
    else if (file_.writes())
      sample_all();
    else
      look_up();
  }

  /// Samples are kept for a frame, in which nothing moves: in one space as in another. It must exist, though.
  void check_space() {
    const std::string_view name = query_.cache_space;
    Matrix4 unused;
    if (name.empty() || name == "current" || name == "object" || name == "shader" ||
        tracer_.services_.current_to_space(state_, name, unused))
      return;
    space_problem_ = "there is no coordinate system \"" + std::string(name) + "\"";
  }

  bool wanted(size_t i) const { return mask_[i / 64] >> (i % 64) & 1; }
  /// Also for the neighbours of a hit.
  void store_all(size_t point, const HemisphereSample& s) const {
    for (size_t i = point; i < query_.points; i += asked_)
      store(query_, i, s);
  }
  /// By which a sample may differ from what its surroundings foretell: half of what is noise in it does not
  /// count.
  float tolerance() const { return 0.1f * max_error_ + 0.3f / std::sqrt(std::max(query_.samples, 1.0f)); }

  void sample_all() {
    std::vector<HemispherePoint> wanted_points;
    std::vector<uint32_t> numbers;
    for (const HemispherePoint& p : points_)
      if (wanted(p.number)) {
        wanted_points.push_back(p);
        numbers.push_back(p.number);
      }
    std::vector<HemisphereSample> samples(numbers.size());
    sampler_.sample(wanted_points, samples);
    for (size_t k = 0; k < numbers.size(); ++k)
      store_all(numbers[k], samples[k]);
    keep(numbers, samples);
  }

  /// Hands samples of some points to the file.
  void keep(std::span<const uint32_t> numbers, std::span<const HemisphereSample> samples) {
    if (!file_.writes()) return;
    const bool lattice = grid_.lattice == slvm::Lattice::kRows;
    const std::vector<float> radii =
        lattice ? sample_radii(points_, grid_.nu(), grid_.nv(), mask_.data(), numbers)
                : std::vector<float>(numbers.size());
    for (size_t k = 0; k < numbers.size(); ++k)
      file_.keep(points_[numbers[k]], samples[k], radii[k], max_error_ > 0 && whole_);
  }

  float pixel_at(Vec3 P) const {
    const Camera& camera = tracer_.camera_;
    return 1 / camera.pixels_per_unit(camera.perspective() ? std::max(glm::length(P), camera.near_plane())
                                                           : 1.0f);
  }

  /// Makes the element of a point what a micropolygon there covers, as a function of the place alone: points
  /// that grids share must stay the same.
  void take_pixel(HemispherePoint& p) const {
    const auto* primitive = static_cast<const Primitive*>(grid_.user);
    const float side = pixel_at(p.P) * (primitive ? std::sqrt(primitive->attributes().shading_rate) : 1.0f);
    const Vec3 view = tracer_.camera_.perspective() ? p.P : Vec3(0, 0, 1);
    const float length = glm::length(view), slope = length > 0 ? glm::dot(view, p.N) / length : 1.0f;
    Vec3 x, y;
    basis_about(p.N, x, y);
    // Longer where it is seen at an angle, in the direction of that.
    if (Vec3 along = view - p.N * glm::dot(view, p.N); glm::dot(along, along) > 1e-12f * length * length) {
      x = glm::normalize(along);
      y = glm::cross(p.N, x);
    }
    p.along_u = x * (side / std::max(std::abs(slope), 0.25f));
    p.along_v = y * side;
  }

  RecordRule rule_at(const HemispherePoint& p) const {
    const float pixel = pixel_at(p.P);
    return {sampler_.call_hash(p), max_error_, tolerance(), pixel, std::max(most_pixels_, 1.0f) * pixel};
  }

  HemisphereSample sample_at(const HemispherePoint& p) {
    HemisphereCache::Key key(p.P, p.N, sampler_.call_hash(p));
    if (auto known = tracer_.cache_->find(key)) return *known;
    const RecordRule rule = rule_at(p);
    HemisphereSample s;
    sampler_.sample({&p, 1}, {&s, 1});
    s = refined(p, s, std::min(max_error_ * reach_of(s), rule.farthest) / rule.nearest);
    tracer_.cache_->add(key, s);
    tracer_.records_->add(rule, p.P, p.N, s);
    return s;
  }

  /// A sample that stands for many pixels is worth more than few rays: noise that is interpolated becomes
  /// blotches, which no pixel filter takes away.
  HemisphereSample refined(HemispherePoint p, const HemisphereSample& first, float pixels) {
    const float most = std::min(kMostPasses, kRaysOfPasses / std::max(query_.samples, 1.0f));
    const int passes = static_cast<int>(std::clamp(pixels / kPixelsAPass, 1.0f, std::max(most, 1.0f)));
    if (passes == 1) return first;
    std::vector<HemisphereSample> samples{first};
    for (int i = 1; i < passes; ++i) {
      p.pass = static_cast<uint32_t>(i);
      sampler_.sample({&p, 1}, {&samples.emplace_back(), 1});
    }
    return mean_of(samples);
  }

  void fill_between() {
    const auto* primitive = static_cast<const Primitive*>(grid_.user);
    LatticeProblem problem;
    problem.nu = grid_.nu();
    problem.nv = grid_.nv();
    problem.points = points_;
    problem.mask = mask_.data();
    problem.max_error = max_error_;
    problem.tolerance = tolerance();
    float step = primitive ? std::sqrt(primitive->attributes().shading_rate) : 1.0f;
    problem.most_steps = static_cast<int>(std::clamp(most_pixels_ / step, 1.0f, 1e6f));
    std::vector<uint32_t> taken;
    std::vector<HemisphereSample> kept;
    problem.sample = [&](const HemispherePoint& p) {
      if (auto found = file_.find(p, max_error_)) return *found;
      const HemisphereSample s = sample_at(p);
      if (file_.writes()) {
        taken.push_back(p.number);
        kept.push_back(s);
      }
      return s;
    };
    std::vector<HemisphereSample> samples = fill_lattice(problem);
    keep(taken, kept);
    for (size_t i = 0; i < samples.size(); ++i)
      if (wanted(i)) store(query_, i, samples[i]);
  }

  void look_up() {
    for (const HemispherePoint& p : points_) {
      if (!wanted(p.number)) continue;
      auto found = file_.find(p, max_error_);
      if (!found) found = tracer_.records_->find(rule_at(p), p.P, p.N);
      store_all(p.number, found ? *found : sample_at(p));
    }
  }

  RayTracer& tracer_;
  const slvm::ShadingState& state_;
  const slvm::Grid& grid_;
  const slvm::HemisphereQuery& query_;
  const RayAttributes& attributes_;
  float max_error_, most_pixels_;
  bool whole_; ///< all points of the grid are asked for
  size_t asked_;
  HemisphereSampler sampler_;
  HemisphereFile file_;
  std::vector<HemispherePoint> points_;
  std::vector<uint64_t> mask_; ///< of points that rays are shot for
  std::string space_problem_;
};

std::string RayTracer::hemisphere(const slvm::ShadingState& state, const slvm::HemisphereQuery& query) {
  return HemisphereRun(*this, state, query).run();
}

} // namespace render
