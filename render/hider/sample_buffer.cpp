// Sampling of micropolygons.
#include "render/hider/sample_buffer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {

namespace {

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
    : settings_(settings), pattern_(settings.size, settings.moving, settings.lens != nullptr, settings.tile),
      reconstructor_(settings.reconstruction, settings.size),
      density_(static_cast<float>(settings.size.xsamples), static_cast<float>(settings.size.ysamples)),
      layers_(settings.layers()), aovs_(settings.aov_floats()) {
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
  layers_.begin(pattern_.count());
  strata_known_ = false;
  if (!settings_.lens) return;
  lens_x_.resize(pattern_.count() + SampleField::kPadding);
  lens_y_.resize(lens_x_.size());
  for (size_t i = 0; i < pattern_.count(); ++i) {
    const Vec2 shift = settings_.lens->lens_to_raster(pattern_.lens(i));
    lens_x_[i] = shift.x;
    lens_y_[i] = shift.y;
  }
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
  layers_.make_layers();
  auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv);
  bool moving = settings_.lens || !grid.times.empty();
  for (size_t j = 0, m = 0; j + 1 < nv; ++j) {
    if (!settings_.lens && !grid.rows.empty() && !grid.rows[j].touches(covered_)) {
      m += nu - 1;
      continue;
    }
    if (moving) reach_.find_row(grid, j);
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      if (grid.hidden[m] == ShadedGrid::kNotDrawn) continue;
      if (!moving) {
        draw_micropolygon(grid, j * nu + i);
        continue;
      }
      const Box reach = reach_.box(i);
      if (settings_.lens || RasterBounds{Vec2(reach.min), Vec2(reach.max)}.touches(covered_))
        draw_moving(grid, j * nu + i, reach);
    }
  }
}

bool SampleBuffer::hides(Vec2 low, Vec2 high, float z) const {
  if (hides(z)) return true;
  SampleWindow window;
  return !find_window((low - origin_) * density_, (high - origin_) * density_, pattern_.width(),
                      pattern_.height(), window) ||
         layers_.hides(window, static_cast<size_t>(pattern_.width()), z);
}

bool SampleBuffer::can_paint(const ShadedGrid& grid) const {
  return grid.times.empty() && !grid.solid && !grid.matte && grid.level.whole() && !settings_.lens &&
         !settings_.mask && settings_.clipping_planes.empty() &&
         settings_.reconstruction.depth_filter != DepthFilter::kMidpoint;
}

void SampleBuffer::paint_grid(const ShadedGrid& grid) {
  static constexpr float kOne = 1, kZero = 0;
  std::vector<PaintedValues> values;
  for (int c = 0; c < 3; ++c)
    values.push_back({grid.Ci.plane(static_cast<size_t>(c)), 1, layers_.plane(Image::kCi + c)});
  for (size_t c = 0; c < aovs_; ++c)
    values.push_back(
        {grid.aov.data() + c * grid.points(), 1, layers_.plane(Image::kAov + static_cast<int>(c))});
  if (!layers_.plain()) {
    for (int c = 0; c < 3; ++c)
      values.push_back({&kOne, 0, layers_.plane(Image::kOi + c)});
    values.push_back({&kZero, 0, layers_.matte()});
  }
  const SampleCanvas canvas{
      covered_,     pattern_.width(),         pattern_.height(),    density_,           pattern_.x(),
      pattern_.y(), layers_.plane(Image::kZ), settings_.near_plane, settings_.far_plane};
  not_painted_.clear();
  layers_.painted(paint(grid, values, canvas, not_painted_));
  if (not_painted_.empty()) return;
  layers_.make_layers();
  for (size_t k : not_painted_)
    draw_micropolygon(grid, k);
}

namespace {

/// For the rounding of moved corners, in pixels.
constexpr float kSlack = 1e-3f;

} // namespace

SampleField SampleBuffer::field(const ShadedGrid& grid) const {
  // Whatever is hidden still bounds a solid.
  const float* limits = grid.solid ? nullptr : layers_.limits();
  SampleField out{pattern_.x(), pattern_.y(), limits, static_cast<size_t>(pattern_.width())};
  out.time = pattern_.times();
  if (settings_.lens) {
    out.lens_x = lens_x_.data();
    out.lens_y = lens_y_.data();
    out.focus = settings_.lens->defocus(kInfinity);
  }
  return out;
}

StratumField SampleBuffer::field(const ShadedGrid& grid, int stratum) {
  const SampleField all = field(grid);
  if (!strata_known_) strata_.sort(pattern_, all);
  strata_known_ = true;
  StratumField out = strata_.of(stratum);
  out.limit = all.limit;
  out.focus = all.focus;
  return out;
}

void SampleBuffer::make_room(const SampleWindow& window) {
  size_t room = 2 * window.count() + SampleField::kPadding;
  if (hits_.size() < room) hits_.resize(room);
}

/// The first hits of hits_, of the micropolygon whose first corner is k.
void SampleBuffer::hit_all(const ShadedGrid& grid, size_t k, size_t count) {
  const std::span<const QuadHit> hits(hits_.data(), count);
  if (!grid.smooth && !grid.solid) {
    hit_flat(grid, k, hits);
    return;
  }
  const auto nu = static_cast<size_t>(grid.nu);
  for (const QuadHit& h : hits) {
    if (!takes(grid, h)) continue;
    const bool first = h.part == QuadPart::kFirst;
    const Spot spot{{k, first ? k + 1 : k + nu + 1, first ? k + nu + 1 : k + nu},
                    {h.weights[0], h.weights[1], h.weights[2]}};
    const SampleSurface surface = surface_at(grid, spot);
    if (grid.solid)
      hit_solid(grid, surface, spot, h);
    else
      add(h.sample, h.z, surface);
  }
}

/// All of the micropolygon looks like its own corner.
void SampleBuffer::hit_flat(const ShadedGrid& grid, size_t k, std::span<const QuadHit> hits) {
  if (hits.empty()) return;
  const SampleSurface surface = surface_at(grid, {{k, k, k}, {1, 0, 0}});
  if (layers_.hides_what_is_behind(surface.Oi)) {
    for (const QuadHit& h : hits)
      if (takes(grid, h)) layers_.cover(h.sample, h.z, surface);
    return;
  }
  if (surface.is_nothing()) return;
  const uint32_t look = layers_.keep(surface);
  for (const QuadHit& h : hits)
    if (takes(grid, h)) layers_.lay(h.sample, h.z, look);
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

SampleBuffer::Defocus SampleBuffer::defocus(const Box& box) const {
  const Camera* lens = settings_.lens;
  return lens ? Defocus{lens->defocus(box.min.z), lens->defocus(box.max.z)} : Defocus{0, 0};
}

void SampleBuffer::add_lens(const Box& shift, const Defocus& by, Box& box) {
  const Vec2 a = Vec2(shift.min) * by.near, b = Vec2(shift.max) * by.near, c = Vec2(shift.min) * by.far,
             d = Vec2(shift.max) * by.far;
  box.min += Vec3(glm::min(glm::min(a, b), glm::min(c, d)), 0);
  box.max += Vec3(glm::max(glm::max(a, b), glm::max(c, d)), 0);
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
void SampleBuffer::draw_moving(const ShadedGrid& grid, size_t k, const Box& reach) {
  Box everywhere = reach;
  const Defocus blur = defocus(reach);
  if (settings_.lens) add_lens(lens_box_, blur, everywhere);
  SampleWindow window;
  if (!find_window(Vec2(everywhere.min) - origin_ - kSlack, Vec2(everywhere.max) - origin_ + kSlack,
                   covered_.width(), covered_.height(), window))
    return;
  if (stays_near(everywhere)) {
    draw_slow(grid, k, reach);
    return;
  }
  const auto nu = static_cast<size_t>(grid.nu);
  const size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  if (grid.times.empty()) {
    MovingQuad quad;
    quad.t0 = 0;
    quad.t1 = 1;
    for (size_t c = 0; c < 4; ++c)
      quad.from[c] = quad.to[c] = grid.position[corner[c]];
    for (int s = 0; s < pattern_.strata(); ++s) {
      Box box = reach;
      add_lens(lens_boxes_[static_cast<size_t>(s)], blur, box);
      draw_in_box(grid, k, box, quad, s);
    }
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

namespace {

/// Around all of it, as the lens has not blurred it.
Box unblurred(const MovingQuad& quad) {
  Box box;
  for (size_t c = 0; c < 4; ++c) {
    box.add(quad.from[c]);
    box.add(quad.to[c]);
  }
  return box;
}

} // namespace

/// What stays within a few pixels: all their samples are looked at together.
void SampleBuffer::draw_slow(const ShadedGrid& grid, size_t k, const Box& reach) {
  const auto nu = static_cast<size_t>(grid.nu);
  const size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  MovingQuad quad;
  for (size_t c = 0; c < 4; ++c)
    quad.to[c] = grid.position[corner[c]];
  quad.t1 = 0;
  const size_t segments = std::max<size_t>(grid.later.size(), 1);
  for (size_t segment = 0; segment < segments; ++segment) {
    quad.t0 = quad.t1;
    quad.t1 = grid.later.empty() ? 1 : grid.times[segment + 1];
    for (size_t c = 0; c < 4; ++c) {
      quad.from[c] = quad.to[c];
      if (!grid.later.empty()) quad.to[c] = grid.later[segment][corner[c]];
    }
    Box box = segments > 1 ? unblurred(quad) : reach;
    if (settings_.lens) add_lens(lens_box_, defocus(box), box);
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
  Box box = unblurred(quad);
  if (settings_.lens) add_lens(lens_boxes_[static_cast<size_t>(stratum)], defocus(box), box);
  draw_in_box(grid, k, box, quad, stratum);
}

/// `box`: around all of it, lens included.
void SampleBuffer::draw_in_box(const ShadedGrid& grid, size_t k, const Box& box, MovingQuad& quad,
                               int stratum) {
  quad.low = Vec2(box.min) - kSlack;
  quad.high = Vec2(box.max) + kSlack;
  SampleWindow window;
  if (!find_window(quad.low - origin_, quad.high - origin_, covered_.width(), covered_.height(), window))
    return;
  make_room(window);
  hit_all(grid, k, moving_hits(quad, grid.solid != nullptr, field(grid, stratum), window, hits_.data()));
}

bool SampleBuffer::removed(size_t index, float z) const {
  if (settings_.mask && settings_.mask->hides(pattern_.at(index) * settings_.mask_scale, z)) return true;
  if (settings_.clipping_planes.empty()) return false;
  Vec2 at = pattern_.at(index);
  if (settings_.lens) at -= Vec2(lens_x_[index], lens_y_[index]) * settings_.lens->defocus(z);
  Vec3 p = settings_.camera->unproject(at, z);
  for (const ClippingPlane& plane : settings_.clipping_planes)
    if (plane.hides(p)) return true;
  return false;
}

/// Whether the sample sees the surface there, as far as it depends on where that is.
bool SampleBuffer::takes(const ShadedGrid& grid, const QuadHit& h) const {
  if (!grid.level.whole() && !grid.level.has(pattern_.level(h.sample))) return false;
  if (grid.solid) return h.z >= settings_.near_plane; // more of it bounds the solid than can be seen
  return h.z < layers_.limits()[h.sample] && h.z >= settings_.near_plane && h.z <= settings_.far_plane &&
         !removed(h.sample, h.z);
}

/// Without smooth shading the micropolygon has the values of its own corner throughout. Valid until the next
/// call.
SampleSurface SampleBuffer::surface_at(const ShadedGrid& grid, const Spot& at) {
  const auto& [a, b, c] = at.corners;
  SampleSurface out{grid.Ci[a], grid.opacity(a), grid.matte};
  if (grid.smooth) {
    out.Ci = blend(out.Ci, grid.Ci[b], grid.Ci[c], at.weights);
    if (!grid.opaque) out.Oi = blend(out.Oi, grid.Oi[b], grid.Oi[c], at.weights);
  }
  blended_aov_.resize(aovs_);
  const float* values = grid.aov.data();
  for (float& v : blended_aov_) {
    v = grid.smooth ? blend(values[a], values[b], values[c], at.weights) : values[a];
    values += grid.points();
  }
  out.aov = blended_aov_.data();
  return out;
}

void SampleBuffer::add(size_t index, float z, const SampleSurface& surface) {
  if (layers_.hides_what_is_behind(surface.Oi))
    layers_.cover(index, z, surface);
  else if (!surface.is_nothing())
    layers_.lay(index, z, layers_.keep(surface));
}

/// Also what is not to be seen, all of which bounds the solid. Nothing is known in front of the near plane.
void SampleBuffer::hit_solid(const ShadedGrid& grid, const SampleSurface& surface, const Spot& at,
                             const QuadHit& hit) {
  // Micropolygons are counted as their first corners are, less one for each row.
  const size_t micropolygon = at.corners[0] - at.corners[0] / static_cast<size_t>(grid.nu);
  const bool unseen = grid.hidden[micropolygon] == ShadedGrid::kFacesAway || hit.z > settings_.far_plane ||
                      removed(hit.sample, hit.z);
  solid_hits_.add(
      {surface.Ci, surface.Oi, hit.z, hit.sample, grid.solid_primitive, grid.matte, unseen, grid.cut_near});
  solid_aov_.insert(solid_aov_.end(), surface.aov, surface.aov + aovs_);
}

void SampleBuffer::resolve_solid() {
  if (solid_hits_.empty()) return;
  solid_hits_.resolve(*solid_, [&](size_t k, const SolidHit& h) {
    if (!(h.z >= layers_.limits()[h.sample]))
      add(h.sample, h.z, {h.Ci, h.Oi, h.matte, solid_aov_.data() + k * aovs_});
  });
  solid_aov_.clear();
}

void SampleBuffer::finish(Image& image) {
  resolve_solid();
  const std::span<const SampleSpan> filled = layers_.find_filled(static_cast<size_t>(pattern_.width()));
  layers_.composite();
  reconstructor_.run({rect_, covered_, pattern_, layers_.finished(), filled}, image);
}

} // namespace render
