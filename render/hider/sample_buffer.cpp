// Sampling of micropolygons, and compositing.
#include "render/hider/sample_buffer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {

namespace {

bool reaches(const Color& opacity, const Color& threshold) {
  return opacity.x >= threshold.x && opacity.y >= threshold.y && opacity.z >= threshold.z;
}

/// Differences, so that equal values stay exactly what they are.
template <class T> T blend(T a, T b, T c, const float (&w)[3]) {
  return a + (b - a) * w[1] + (c - a) * w[2];
}

} // namespace

SamplingSettings SamplingSettings::from(const Options& o, const std::vector<AovChannel>& aovs) {
  SamplingSettings s;
  s.size = {o.xsamples, o.ysamples, o.jitter};
  s.reconstruction = {o.filter, o.depth_filter, o.subpixel, aovs};
  s.opacity_threshold = o.opacity_threshold;
  s.depth_threshold = o.depth_threshold;
  s.near_plane = o.near_plane;
  s.far_plane = o.far_plane;
  s.clipping_planes = o.clipping_planes;
  return s;
}

namespace {

PixelRect with_margins(const PixelRect& r, const ReconstructionSettings& s) {
  int mx = s.xmargin(), my = s.ymargin();
  return {r.x0 - mx, r.y0 - my, r.x1 + mx, r.y1 + my};
}

} // namespace

SampleBuffer::SampleBuffer(const SamplingSettings& settings)
    : settings_(settings), pattern_(settings.size, settings.moving, settings.lens != nullptr),
      reconstructor_(settings.reconstruction, settings.size),
      density_(static_cast<float>(settings.size.xsamples), static_cast<float>(settings.size.ysamples)),
      planes_(Image::kAov + settings.aov_floats()), aovs_(settings.aov_floats()),
      midpoint_(settings.reconstruction.depth_filter == DepthFilter::kMidpoint) {
  for (int s = 0; settings_.lens && s < pattern_.strata(); ++s) {
    auto [low, high] = pattern_.lens_box(s);
    Box& box = lens_boxes_.emplace_back();
    for (float x : {low.x, high.x})
      for (float y : {low.y, high.y})
        box.add(Vec3(settings_.lens->lens_to_raster({x, y}), 0));
    lens_box_.add(box.min);
    lens_box_.add(box.max);
  }
}

void SampleBuffer::begin(PixelRect rect) {
  rect_ = rect;
  covered_ = with_margins(rect, settings_.reconstruction);
  pattern_.cover(covered_);
  origin_ = {static_cast<float>(covered_.x0), static_cast<float>(covered_.y0)};
  open_ = pattern_.count();
  farthest_known_ = false;
  for (size_t c = 0; c < planes_.size(); ++c) // opacities: see make_layers()
    if (c < Image::kOi || c > Image::kAlpha)
      planes_[c].assign(open_ + SampleField::kPadding, c == Image::kZ ? kInfinity : 0.0f);
  if (midpoint_) second_.assign(open_ + SampleField::kPadding, kInfinity);
  plain_ = true;
  fragments_.clear();
  fragment_aov_.clear();
  lens_.clear();
  for (size_t i = 0; settings_.lens && i < open_; ++i)
    lens_.push_back(settings_.lens->lens_to_raster(pattern_.lens(i)));
  if (settings_.lens) lens_.resize(open_ + SampleField::kPadding);
}

void SampleBuffer::draw(const ShadedGrid& grid) {
  if (grid.solid != solid_) {
    resolve_solid();
    solid_ = grid.solid;
  }
  if (can_paint(grid)) {
    paint_grid(grid);
    return;
  }
  make_layers();
  auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv);
  bool moving = settings_.lens || !grid.times.empty();
  for (size_t j = 0, m = 0; j + 1 < nv; ++j) {
    if (!settings_.lens && !grid.rows.empty() && !grid.rows[j].touches(covered_)) {
      m += nu - 1;
      continue;
    }
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      if (grid.hidden[m] == ShadedGrid::kNotDrawn) continue;
      if (moving)
        draw_moving(grid, j * nu + i);
      else
        draw_micropolygon(grid, j * nu + i);
    }
  }
}

bool SampleBuffer::can_paint(const ShadedGrid& grid) const {
  return grid.times.empty() && !grid.solid && !grid.matte && grid.level.whole() && !settings_.lens &&
         !settings_.mask && settings_.clipping_planes.empty() && !midpoint_;
}

void SampleBuffer::paint_grid(const ShadedGrid& grid) {
  static constexpr float kOne = 1, kZero = 0;
  std::vector<PaintedValues> values;
  for (size_t c = 0; c < 3; ++c)
    values.push_back({grid.Ci.plane(c), 1, planes_[Image::kCi + c].data()});
  for (size_t c = 0; c < aovs_; ++c)
    values.push_back({grid.aov.data() + c * grid.points(), 1, planes_[Image::kAov + c].data()});
  for (size_t c = 0; !plain_ && c < 3; ++c)
    values.push_back({&kOne, 0, planes_[Image::kOi + c].data()});
  if (!plain_) values.push_back({&kZero, 0, matte_.data()});
  const SampleCanvas canvas{covered_,        pattern_.width(),     pattern_.height(),
                            density_,        pattern_.x(),         pattern_.y(),
                            depths().data(), settings_.near_plane, settings_.far_plane};
  not_painted_.clear();
  open_ -= paint(grid, values, canvas, not_painted_);
  farthest_known_ = false;
  if (not_painted_.empty()) return;
  make_layers();
  for (size_t k : not_painted_)
    draw_micropolygon(grid, k);
}

void SampleBuffer::make_layers() {
  if (!plain_) return;
  plain_ = false;
  for (int c = Image::kOi; c <= Image::kAlpha; ++c)
    planes_[c].assign(depths().size(), 1.0f);
  matte_.assign(depths().size(), 0.0f);
  fragments_of_.assign(pattern_.count(), kNone);
}

namespace {

/// For the rounding of moved corners, in pixels.
constexpr float kSlack = 1e-3f;

} // namespace

SampleField SampleBuffer::field(const ShadedGrid& grid) const {
  // Whatever is hidden still bounds a solid.
  const float* limits = grid.solid ? nullptr : this->limits().data();
  SampleField out{pattern_.x(), pattern_.y(), limits, static_cast<size_t>(pattern_.width())};
  out.time = pattern_.times();
  if (settings_.lens) {
    out.lens = lens_.data();
    out.focus = settings_.lens->defocus(kInfinity);
  }
  return out;
}

void SampleBuffer::make_room(const SampleWindow& window) {
  size_t room = 2 * window.count() + SampleField::kPadding;
  if (hits_.size() < room) hits_.resize(room);
}

/// The first hits of hits_, of the micropolygon whose first corner is k.
void SampleBuffer::hit_all(const ShadedGrid& grid, size_t k, size_t count) {
  auto nu = static_cast<size_t>(grid.nu);
  for (const QuadHit& h : std::span(hits_.data(), count)) {
    bool first = h.part == QuadPart::kFirst;
    hit(grid, h.sample, {k, first ? k + 1 : k + nu + 1, first ? k + nu + 1 : k + nu}, h.weights, h.z);
  }
}

void SampleBuffer::draw_micropolygon(const ShadedGrid& grid, size_t k) {
  auto nu = static_cast<size_t>(grid.nu);
  const Vec3Planes& position = grid.position;
  const Vec3 p[4] = {position[k], position[k + 1], position[k + nu], position[k + nu + 1]};
  Vec2 low = glm::min(glm::min(Vec2(p[0]), Vec2(p[1])), glm::min(Vec2(p[2]), Vec2(p[3])));
  Vec2 high = glm::max(glm::max(Vec2(p[0]), Vec2(p[1])), glm::max(Vec2(p[2]), Vec2(p[3])));
  SampleWindow window;
  if (!find_window((low - origin_) * density_, (high - origin_) * density_, pattern_.width(),
                   pattern_.height(), window))
    return;
  make_room(window);
  hit_all(grid, k, quad_hits(p, grid.solid != nullptr, field(grid), window, hits_.data()));
}

/// Makes room for what the lens does to the box: `shift`, by the defocus of its depths.
void SampleBuffer::add_lens(const Box& shift, Box& box) const {
  const Camera* lens = settings_.lens;
  if (!lens) return;
  float a = lens->defocus(box.min.z), b = lens->defocus(box.max.z);
  box.min += glm::min(glm::min(shift.min * a, shift.max * a), glm::min(shift.min * b, shift.max * b));
  box.max += glm::max(glm::max(shift.min * a, shift.max * a), glm::max(shift.min * b, shift.max * b));
}

namespace {

/// Whether a box of the raster touches but a few pixels, in this bucket or in others: pictures must not
/// depend on buckets.
bool stays_near(const Box& box) {
  constexpr float kPixels = 16;
  auto touched = [](float from, float to) { return std::floor(to) - std::floor(from) + 1; };
  return touched(box.min.x, box.max.x) * touched(box.min.y, box.max.y) <= kPixels;
}

} // namespace

/// For each stratum of time and lens only the pixels are looked at that the micropolygon reaches in it, and
/// there the one sample that belongs to the stratum.
void SampleBuffer::draw_moving(const ShadedGrid& grid, size_t k) {
  auto nu = static_cast<size_t>(grid.nu);
  const size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  Box everywhere;
  for (size_t c : corner) {
    everywhere.add(grid.position[c]);
    for (const Vec3Planes& later : grid.later)
      everywhere.add(later[c]);
  }
  add_lens(lens_box_, everywhere);
  SampleWindow window;
  if (!find_window(Vec2(everywhere.min) - origin_ - kSlack, Vec2(everywhere.max) - origin_ + kSlack,
                   covered_.width(), covered_.height(), window))
    return;
  if (stays_near(everywhere)) {
    draw_slow(grid, k);
    return;
  }
  auto n = static_cast<float>(pattern_.strata());
  for (int s = 0; s < pattern_.strata(); ++s) {
    float end = static_cast<float>(s + 1) / n;
    MovingQuad quad;
    quad.t1 = static_cast<float>(s) / n;
    for (size_t c = 0; c < 4; ++c)
      quad.to[c] = grid.at(corner[c], quad.t1);
    // In pieces where the motion turns within the stratum.
    while (quad.t1 < end) {
      quad.t0 = std::exchange(quad.t1, end);
      for (float t : grid.times)
        if (t > quad.t0) quad.t1 = std::min(quad.t1, t);
      for (size_t c = 0; c < 4; ++c) {
        quad.from[c] = quad.to[c];
        quad.to[c] = grid.at(corner[c], quad.t1);
      }
      draw_segment(grid, k, quad, s);
    }
  }
}

/// What stays within a few pixels: all their samples are looked at together.
void SampleBuffer::draw_slow(const ShadedGrid& grid, size_t k) {
  const auto nu = static_cast<size_t>(grid.nu);
  const size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  MovingQuad quad;
  for (size_t c = 0; c < 4; ++c)
    quad.to[c] = grid.position[corner[c]];
  quad.t1 = 0;
  for (size_t segment = 0; segment < std::max<size_t>(grid.later.size(), 1); ++segment) {
    quad.t0 = quad.t1;
    quad.t1 = grid.later.empty() ? 1 : grid.times[segment + 1];
    Box box;
    for (size_t c = 0; c < 4; ++c) {
      quad.from[c] = quad.to[c];
      if (!grid.later.empty()) quad.to[c] = grid.later[segment][corner[c]];
      box.add(quad.from[c]);
      box.add(quad.to[c]);
    }
    add_lens(lens_box_, box);
    quad.low = Vec2(box.min) - kSlack;
    quad.high = Vec2(box.max) + kSlack;
    SampleWindow samples;
    if (!find_window((quad.low - origin_) * density_, (quad.high - origin_) * density_, pattern_.width(),
                     pattern_.height(), samples))
      continue;
    make_room(samples);
    hit_all(grid, k, slow_hits(quad, grid.solid != nullptr, field(grid), samples, hits_.data()));
  }
}

void SampleBuffer::draw_segment(const ShadedGrid& grid, size_t k, MovingQuad& quad, int stratum) {
  Box box;
  for (size_t c = 0; c < 4; ++c) {
    box.add(quad.from[c]);
    box.add(quad.to[c]);
  }
  if (settings_.lens) add_lens(lens_boxes_[static_cast<size_t>(stratum)], box);
  quad.low = Vec2(box.min) - kSlack;
  quad.high = Vec2(box.max) + kSlack;
  SampleWindow window;
  if (!find_window(quad.low - origin_, quad.high - origin_, covered_.width(), covered_.height(), window))
    return;
  make_room(window);
  hit_all(grid, k,
          moving_hits(quad, grid.solid != nullptr, field(grid), pattern_.of_stratum(stratum),
                      static_cast<size_t>(covered_.width()), window, hits_.data()));
}

bool SampleBuffer::removed(size_t index, float z) const {
  if (settings_.mask && settings_.mask->hides(pattern_.at(index) * settings_.mask_scale, z)) return true;
  if (settings_.clipping_planes.empty()) return false;
  Vec2 at = pattern_.at(index);
  if (settings_.lens) at -= lens_[index] * settings_.lens->defocus(z);
  Vec3 p = settings_.camera->unproject(at, z);
  for (const ClippingPlane& plane : settings_.clipping_planes)
    if (plane.hides(p)) return true;
  return false;
}

namespace {

/// corners[0] is the micropolygon's own corner, whose values it has throughout without smooth shading.
Color colour_of(const ShadedGrid& grid, const size_t (&corners)[3], const float (&weights)[3]) {
  const Color own = grid.Ci[corners[0]];
  return grid.smooth ? blend(own, grid.Ci[corners[1]], grid.Ci[corners[2]], weights) : own;
}

Color opacity_of(const ShadedGrid& grid, const size_t (&corners)[3], const float (&weights)[3]) {
  const Color own = grid.opacity(corners[0]);
  if (!grid.smooth || grid.opaque) return own;
  return blend(own, grid.Oi[corners[1]], grid.Oi[corners[2]], weights);
}

} // namespace

void SampleBuffer::hit(const ShadedGrid& grid, size_t index, const size_t (&corners)[3],
                       const float (&weights)[3], float z) {
  if (!grid.level.whole() && !grid.level.has(pattern_.level(index))) return;
  if (grid.solid) {
    hit_solid(grid, index, corners, weights, z);
    return;
  }
  if (z >= limits()[index] || z < settings_.near_plane || z > settings_.far_plane) return;
  if (removed(index, z)) return;
  add(index, colour_of(grid, corners, weights), opacity_of(grid, corners, weights), z, grid.matte,
      variables_of(grid, corners, weights));
}

Color SampleBuffer::colour(size_t index, int channel) const {
  return {planes_[channel][index], planes_[channel + 1][index], planes_[channel + 2][index]};
}

void SampleBuffer::set_colour(size_t index, int channel, const Color& c) {
  for (int i = 0; i < 3; ++i)
    planes_[channel + i][index] = c[i];
}

void SampleBuffer::set_aov(size_t index, const float* values) {
  for (size_t k = 0; k < aovs_; ++k)
    planes_[Image::kAov + k][index] = values[k];
}

/// The variables of displays, as colour_of(). Valid until the next call.
const float* SampleBuffer::variables_of(const ShadedGrid& grid, const size_t (&corners)[3],
                                        const float (&weights)[3]) {
  if (aovs_ == 0) return nullptr;
  blended_aov_.resize(aovs_);
  const float* values = grid.aov.data();
  for (size_t k = 0; k < aovs_; ++k, values += grid.points()) {
    const float own = values[corners[0]];
    blended_aov_[k] = grid.smooth ? blend(own, values[corners[1]], values[corners[2]], weights) : own;
  }
  return blended_aov_.data();
}

/// Also what is not to be seen, all of which bounds the solid. Nothing is known in front of the near plane.
void SampleBuffer::hit_solid(const ShadedGrid& grid, size_t index, const size_t (&corners)[3],
                             const float (&weights)[3], float z) {
  if (!(z >= settings_.near_plane)) return;
  // Micropolygons are counted as their first corners are, less one for each row.
  size_t micropolygon = corners[0] - corners[0] / static_cast<size_t>(grid.nu);
  bool unseen =
      grid.hidden[micropolygon] == ShadedGrid::kFacesAway || z > settings_.far_plane || removed(index, z);
  solid_hits_.add({colour_of(grid, corners, weights), opacity_of(grid, corners, weights), z,
                   static_cast<uint32_t>(index), grid.solid_primitive, grid.matte, unseen, grid.cut_near});
  const float* aov = variables_of(grid, corners, weights);
  solid_aov_.insert(solid_aov_.end(), aov, aov + aovs_);
}

void SampleBuffer::resolve_solid() {
  if (solid_hits_.empty()) return;
  solid_hits_.resolve(*solid_, [&](size_t k, const SolidHit& h) {
    if (!(h.z >= limits()[h.sample])) add(h.sample, h.Ci, h.Oi, h.z, h.matte, solid_aov_.data() + k * aovs_);
  });
  solid_aov_.clear();
}

void SampleBuffer::add(size_t index, const Color& Ci, const Color& Oi, float z, bool matte,
                       const float* aov) {
  float& nearest = depths()[index];
  if (reaches(Oi, settings_.opacity_threshold)) {
    farthest_known_ = false;
    float& limit = limits()[index];
    bool was_open = limit == kInfinity;
    if (midpoint_) limit = std::min(limit, std::max(z, nearest));
    bool in_front = z < nearest;
    if (in_front) nearest = z;
    if (was_open && limit < kInfinity) --open_;
    if (!in_front) return;
    set_colour(index, Image::kCi, Ci);
    set_colour(index, Image::kOi, Oi);
    matte_[index] = matte ? 1.0f : 0.0f;
    set_aov(index, aov);
    return;
  }
  if (z >= nearest || (Ci == Color(0.0f) && Oi == Color(0.0f))) return; // hidden, or not there at all
  auto order = static_cast<uint32_t>(fragments_.size());
  fragments_.push_back({Ci, Oi, z, fragments_of_[index], order, matte});
  fragment_aov_.insert(fragment_aov_.end(), aov, aov + aovs_);
  fragments_of_[index] = order;
}

namespace {

/// Of numbers that are not negative; in lanes, for the compiler to use vectors.
float greatest(std::span<const float> values) {
  constexpr size_t kLanes = 16;
  float most[kLanes] = {};
  size_t k = 0;
  for (; k + kLanes <= values.size(); k += kLanes)
    for (size_t i = 0; i < kLanes; ++i)
      most[i] = most[i] < values[k + i] ? values[k + i] : most[i];
  for (; k < values.size(); ++k)
    most[0] = std::max(most[0], values[k]);
  return *std::max_element(most, most + kLanes);
}

} // namespace

float SampleBuffer::farthest() const {
  if (open_ > 0) return kInfinity;
  if (!farthest_known_) {
    farthest_ = greatest(std::span(limits().data(), pattern_.count()));
    farthest_known_ = true;
  }
  return farthest_;
}

/// Front to back: C += T Ci, T *= 1 - Oi for each component, until the opacity threshold (RISpec 3.2, 4.2).
/// The depth is that of the first surface opaque enough to have one.
void SampleBuffer::composite(size_t index) {
  const bool matte_behind = matte_[index] != 0;
  const float nearest = depths()[index], depth_behind = opaque_depth(index);
  scratch_.clear();
  for (uint32_t f = fragments_of_[index]; f != kNone; f = fragments_[f].next)
    if (fragments_[f].z < nearest) scratch_.push_back(&fragments_[f]);
  std::sort(scratch_.begin(), scratch_.end(), [](const Fragment* a, const Fragment* b) {
    return a->z != b->z ? a->z < b->z : a->order < b->order;
  });
  Color C(0.0f), O(0.0f), through(1.0f);
  auto add = [&](Color Ci, Color Oi, bool matte) {
    if (!matte) {
      C += through * Ci;
      O += through * Oi;
    }
    through *= Color(1.0f) - Oi;
  };
  float depth = kInfinity;
  bool seen = false, closed = false;
  for (const Fragment* f : scratch_) {
    if (!seen && !f->matte) {
      seen = true;
      set_aov(index, fragment_aov_.data() + f->order * aovs_);
    }
    if (!f->matte && reaches(f->Oi, settings_.depth_threshold)) depth = std::min(depth, f->z);
    add(f->Ci, f->Oi, f->matte);
    closed = reaches(Color(1.0f) - through, settings_.opacity_threshold);
    if (closed) break;
  }
  if (!closed && nearest < kInfinity) {
    add(colour(index, Image::kCi), colour(index, Image::kOi), matte_behind);
    if (matte_behind && !seen)
      for (size_t k = 0; k < aovs_; ++k)
        planes_[Image::kAov + k][index] = 0;
  }
  if (!matte_behind) depth = std::min(depth, depth_behind);
  depths()[index] = depth;
  set_colour(index, Image::kCi, C);
  set_colour(index, Image::kOi, O);
  planes_[Image::kAlpha][index] = (O.x + O.y + O.z) / 3;
}

/// The depth of what is opaque; with midpoints, half way to what is behind it.
float SampleBuffer::opaque_depth(size_t index) const {
  float nearest = depths()[index];
  return midpoint_ && second_[index] < kInfinity ? 0.5f * (nearest + second_[index]) : nearest;
}

void SampleBuffer::find_filled() {
  const auto width = static_cast<size_t>(pattern_.width());
  auto is_empty = [&](size_t k) { return depths()[k] == kInfinity && (plain_ || fragments_of_[k] == kNone); };
  filled_.assign(static_cast<size_t>(pattern_.height()), {});
  for (size_t j = 0; j < filled_.size(); ++j) {
    SampleSpan row{0, width};
    while (row.begin < row.end && is_empty(j * width + row.begin))
      ++row.begin;
    while (row.begin < row.end && is_empty(j * width + row.end - 1))
      --row.end;
    filled_[j] = row;
  }
}

namespace {

/// Sets the opacities of what has nothing to 0, and alpha to the mean of the three; in vectors.
void find_alpha(std::span<const float> depth, float* __restrict r, float* __restrict g, float* __restrict b,
                float* __restrict alpha) {
  for (size_t k = 0; k < depth.size(); ++k) {
    const float covered = depth[k] < kInfinity ? 1.0f : 0.0f;
    r[k] *= covered;
    g[k] *= covered;
    b[k] *= covered;
    alpha[k] = (r[k] + g[k] + b[k]) / 3;
  }
}

} // namespace

/// What there are no layers over is soon done: only the coverage is left to find out.
void SampleBuffer::composite_all() {
  const size_t count = pattern_.count();
  std::vector<float>&depth = depths(), &alpha = planes_[Image::kAlpha];
  alpha.resize(depth.size());
  if (plain_) {
    for (size_t k = 0; k < count; ++k)
      alpha[k] = depth[k] < kInfinity ? 1.0f : 0.0f;
    return;
  }
  find_alpha(std::span(depth.data(), count), planes_[Image::kOi].data(), planes_[Image::kOi + 1].data(),
             planes_[Image::kOi + 2].data(), alpha.data());
  for (size_t k = 0; k < count; ++k)
    if (fragments_of_[k] != kNone || matte_[k] != 0)
      composite(k);
    else if (midpoint_)
      depth[k] = opaque_depth(k);
}

std::vector<const float*> SampleBuffer::planes() const {
  std::vector<const float*> out;
  for (const std::vector<float>& plane : planes_)
    out.push_back(plane.data());
  for (int c = Image::kOi; plain_ && c < Image::kAlpha; ++c)
    out[static_cast<size_t>(c)] = out[Image::kAlpha];
  return out;
}

void SampleBuffer::finish(Image& image) {
  resolve_solid();
  find_filled();
  composite_all();
  const std::vector<const float*> planes = this->planes();
  reconstructor_.run({rect_, covered_, pattern_, planes, filled_}, image);
}

} // namespace render
