// Sampling of micropolygons, and compositing.
#include "render/hider/sample_buffer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace render {

namespace {

/// Twice the signed area of a, b, p, computed the same way for b, a, p, so that of two triangles that share
/// an edge exactly one contains a sample on or near it.
struct Edge {
  Vec2 a, d;
  bool swapped;
  Edge(Vec2 from, Vec2 to) {
    swapped = to.x < from.x || (to.x == from.x && to.y < from.y);
    a = swapped ? to : from;
    d = swapped ? from - to : to - from;
  }
  float value(Vec2 p) const { return d.x * (p.y - a.y) - d.y * (p.x - a.x); }
  bool left(float value) const { return (value >= 0) != swapped; }
};

/// A micropolygon as two triangles with the side a-d in common: a, b, d and a, d, c.
struct Quad {
  Edge ab, bd, da, dc, ca;
  Quad(Vec2 a, Vec2 b, Vec2 c, Vec2 d) : ab(a, b), bd(b, d), da(d, a), dc(d, c), ca(c, a) {}
  enum Part { kOutside, kFirst, kSecond };
  /// The triangle p is in, and its barycentric weights there, in the order above. A folded micropolygon may
  /// cover p twice: the other triangle is found `after` the first.
  Part find(Vec2 p, float (&weights)[3], Part after = kOutside) const {
    float diagonal = da.value(p);
    bool side = da.left(diagonal);
    if (float e = ab.value(p); after == kOutside && ab.left(e) == side)
      if (float f = bd.value(p); bd.left(f) == side) return weigh(f, diagonal, e, kFirst, weights);
    if (float e = dc.value(p); dc.left(e) != side)
      if (float f = ca.value(p); ca.left(f) != side) return weigh(e, f, diagonal, kSecond, weights);
    return kOutside;
  }

private:
  static Part weigh(float a, float b, float c, Part part, float (&weights)[3]) {
    a = std::abs(a);
    b = std::abs(b);
    c = std::abs(c);
    float sum = a + b + c;
    if (!(sum > 0)) return kOutside;
    weights[0] = a / sum;
    weights[1] = b / sum;
    weights[2] = c / sum;
    return part;
  }
};

bool reaches(Color opacity, Color threshold) {
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

SampleBuffer::SampleBuffer(PixelRect rect, const SamplingSettings& settings)
    : settings_(settings), rect_(rect), covered_(with_margins(rect, settings.reconstruction)),
      pattern_(covered_, settings.size, settings.moving || settings.lens), samples_(pattern_.count()),
      aovs_(settings.aov_floats()), sample_aov_(samples_.size() * aovs_), open_(samples_.size()),
      midpoint_(settings.reconstruction.depth_filter == DepthFilter::kMidpoint) {
  if (!settings_.lens) return;
  for (size_t i = 0; i < samples_.size(); ++i)
    lens_.push_back(settings_.lens->lens_to_raster(pattern_.lens(i)));
  for (int s = 0; s < pattern_.strata(); ++s) {
    auto [low, high] = pattern_.lens_box(s);
    Box& box = lens_boxes_.emplace_back();
    for (float x : {low.x, high.x})
      for (float y : {low.y, high.y})
        box.add(Vec3(settings_.lens->lens_to_raster({x, y}), 0));
  }
}

void SampleBuffer::draw(const ShadedGrid& grid) {
  if (grid.solid != solid_) {
    resolve_solid();
    solid_ = grid.solid;
  }
  auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv);
  bool moving = settings_.lens || !grid.times.empty();
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      if (grid.hidden[m] == ShadedGrid::kNotDrawn) continue;
      if (moving)
        draw_moving(grid, j * nu + i);
      else
        draw_micropolygon(grid, j * nu + i);
    }
}

namespace {

/// The whole numbers from `from` to `to`, both included, that are below `size`.
void cells(float from, float to, int size, int& begin, int& end) {
  // What is clamped at 0 is cut off like floor().
  auto limit = static_cast<float>(size);
  begin = static_cast<int>(std::clamp(from, 0.0f, limit));
  end = to < 0 ? 0 : static_cast<int>(std::min(to + 1, limit));
}

} // namespace

void SampleBuffer::draw_micropolygon(const ShadedGrid& grid, size_t k) {
  auto nu = static_cast<size_t>(grid.nu);
  const auto& position = grid.position;
  Vec2 p[4] = {Vec2(position[k]), Vec2(position[k + 1]), Vec2(position[k + nu]), Vec2(position[k + nu + 1])};
  Vec2 low = glm::min(glm::min(p[0], p[1]), glm::min(p[2], p[3]));
  Vec2 high = glm::max(glm::max(p[0], p[1]), glm::max(p[2], p[3]));
  auto xs = static_cast<float>(settings_.size.xsamples), ys = static_cast<float>(settings_.size.ysamples);
  auto x0 = static_cast<float>(covered_.x0), y0 = static_cast<float>(covered_.y0);
  int i0, i1, j0, j1;
  cells((low.x - x0) * xs, (high.x - x0) * xs, pattern_.width(), i0, i1);
  cells((low.y - y0) * ys, (high.y - y0) * ys, pattern_.height(), j0, j1);
  if (i0 >= i1 || j0 >= j1) return;
  std::optional<Quad> quad; // most small micropolygons have no sample even in their box
  float weights[3];
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      size_t index = static_cast<size_t>(j) * static_cast<size_t>(pattern_.width()) + static_cast<size_t>(i);
      Vec2 at = pattern_.at(index);
      if (at.x < low.x || at.x > high.x || at.y < low.y || at.y > high.y) continue;
      if (!quad) quad.emplace(p[0], p[1], p[2], p[3]);
      Quad::Part part = quad->find(at, weights);
      while (part != Quad::kOutside) {
        size_t second = part == Quad::kFirst ? k + 1 : k + nu + 1,
               third = part == Quad::kFirst ? k + nu + 1 : k + nu;
        hit(grid, index, {k, second, third}, weights,
            blend(position[k].z, position[second].z, position[third].z, weights));
        part = grid.solid && part == Quad::kFirst ? quad->find(at, weights, part) : Quad::kOutside;
      }
    }
}

/// For each stratum of time and lens only the pixels are looked at that the micropolygon reaches in it, and
/// there the one sample that belongs to the stratum.
void SampleBuffer::draw_moving(const ShadedGrid& grid, size_t k) {
  auto nu = static_cast<size_t>(grid.nu);
  const size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  const Camera* lens = settings_.lens;
  constexpr float kSlack = 1e-3f;
  auto n = static_cast<float>(pattern_.strata());
  bool still = grid.times.empty();
  Vec3 now[4], next[4];
  float defocus[4] = {};
  for (size_t c = 0; c < 4; ++c) {
    now[c] = next[c] = grid.position[corner[c]];
    if (lens) defocus[c] = lens->defocus(now[c].z);
  }
  for (int s = 0; s < pattern_.strata(); ++s) {
    float from = static_cast<float>(s) / n, to = static_cast<float>(s + 1) / n;
    Box box;
    for (size_t c = 0; c < 4; ++c) {
      box.add(now[c]);
      if (still) continue;
      box.add(next[c] = grid.at(corner[c], to));
      now[c] = next[c];
      for (size_t t = 0; t < grid.times.size(); ++t)
        if (grid.times[t] > from && grid.times[t] < to) box.add(grid.position[t * grid.points() + corner[c]]);
    }
    if (lens) {
      const Box& shift = lens_boxes_[static_cast<size_t>(s)];
      float a = lens->defocus(box.min.z), b = lens->defocus(box.max.z);
      box.min += glm::min(glm::min(shift.min * a, shift.max * a), glm::min(shift.min * b, shift.max * b));
      box.max += glm::max(glm::max(shift.min * a, shift.max * a), glm::max(shift.min * b, shift.max * b));
    }
    int i0, i1, j0, j1;
    cells(box.min.x - kSlack - static_cast<float>(covered_.x0),
          box.max.x + kSlack - static_cast<float>(covered_.x0), covered_.width(), i0, i1);
    cells(box.min.y - kSlack - static_cast<float>(covered_.y0),
          box.max.y + kSlack - static_cast<float>(covered_.y0), covered_.height(), j0, j1);
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) {
        size_t index = pattern_.of_stratum(i, j, s);
        Vec3 p[4];
        for (size_t c = 0; c < 4; ++c) {
          p[c] = still ? now[c] : grid.at(corner[c], pattern_.time(index));
          if (lens) p[c] += Vec3(lens_[index] * (still ? defocus[c] : lens->defocus(p[c].z)), 0);
        }
        float weights[3];
        Quad quad{Vec2(p[0]), Vec2(p[1]), Vec2(p[2]), Vec2(p[3])};
        Quad::Part part = quad.find(pattern_.at(index), weights);
        while (part != Quad::kOutside) {
          size_t second = part == Quad::kFirst ? 1 : 3, third = part == Quad::kFirst ? 3 : 2;
          hit(grid, index, {corner[0], corner[second], corner[third]}, weights,
              blend(p[0].z, p[second].z, p[third].z, weights));
          part = grid.solid && part == Quad::kFirst ? quad.find(pattern_.at(index), weights, part)
                                                    : Quad::kOutside;
        }
      }
  }
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

/// A colour or opacity. corners[0] is the micropolygon's own corner, whose colour it has throughout without
/// smooth shading.
Color colour_of(const ShadedGrid& grid, const std::vector<Color>& colours, const size_t (&corners)[3],
                const float (&weights)[3]) {
  const Color& own = colours[corners[0]];
  return grid.smooth ? blend(own, colours[corners[1]], colours[corners[2]], weights) : own;
}

} // namespace

void SampleBuffer::hit(const ShadedGrid& grid, size_t index, const size_t (&corners)[3],
                       const float (&weights)[3], float z) {
  if (!grid.level.whole() && !grid.level.has(pattern_.level(index))) return;
  if (grid.solid) {
    hit_solid(grid, index, corners, weights, z);
    return;
  }
  if (behind(samples_[index], z) || z < settings_.near_plane || z > settings_.far_plane) return;
  if (removed(index, z)) return;
  add(index, colour_of(grid, grid.Ci, corners, weights), colour_of(grid, grid.Oi, corners, weights), z,
      grid.matte, variables_of(grid, corners, weights));
}

/// The variables of displays, as colour_of(). Valid until the next call.
const float* SampleBuffer::variables_of(const ShadedGrid& grid, const size_t (&corners)[3],
                                        const float (&weights)[3]) {
  const float* values[3];
  for (size_t c = 0; c < 3; ++c)
    values[c] = grid.aov.data() + corners[c] * aovs_;
  if (!grid.smooth) return values[0];
  blended_aov_.resize(aovs_);
  for (size_t k = 0; k < aovs_; ++k)
    blended_aov_[k] = blend(values[0][k], values[1][k], values[2][k], weights);
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
  solid_hits_.add({colour_of(grid, grid.Ci, corners, weights), colour_of(grid, grid.Oi, corners, weights), z,
                   static_cast<uint32_t>(index), grid.solid_primitive, grid.matte, unseen, grid.cut_near});
  const float* aov = variables_of(grid, corners, weights);
  solid_aov_.insert(solid_aov_.end(), aov, aov + aovs_);
}

void SampleBuffer::resolve_solid() {
  if (solid_hits_.empty()) return;
  solid_hits_.resolve(*solid_, [&](size_t k, const SolidHit& h) {
    if (!behind(samples_[h.sample], h.z))
      add(h.sample, h.Ci, h.Oi, h.z, h.matte, solid_aov_.data() + k * aovs_);
  });
  solid_aov_.clear();
}

void SampleBuffer::add(size_t index, Color Ci, Color Oi, float z, bool matte, const float* aov) {
  Sample& sample = samples_[index];
  if (reaches(Oi, settings_.opacity_threshold)) {
    farthest_known_ = false;
    bool was_open = (midpoint_ ? sample.second : sample.z) == kInfinity;
    sample.second = std::min(sample.second, std::max(z, sample.z));
    if (was_open && (midpoint_ ? sample.second : z) < kInfinity) --open_;
    if (z >= sample.z) return;
    sample.z = z;
    sample.Ci = Ci;
    sample.Oi = Oi;
    sample.matte = matte;
    std::copy_n(aov, aovs_, sample_aov_.begin() + static_cast<std::ptrdiff_t>(index * aovs_));
    return;
  }
  if (z >= sample.z || (Ci == Color(0.0f) && Oi == Color(0.0f))) return; // hidden, or not there at all
  auto order = static_cast<uint32_t>(fragments_.size());
  fragments_.push_back({Ci, Oi, z, sample.fragments, order, matte});
  fragment_aov_.insert(fragment_aov_.end(), aov, aov + aovs_);
  sample.fragments = order;
}

float SampleBuffer::farthest() const {
  if (open_ > 0) return kInfinity;
  if (!farthest_known_) {
    farthest_ = 0;
    for (const Sample& s : samples_)
      farthest_ = std::max(farthest_, midpoint_ ? s.second : s.z);
    farthest_known_ = true;
  }
  return farthest_;
}

/// Front to back: C += T Ci, T *= 1 - Oi for each component, until the opacity threshold (RISpec 3.2, 4.2).
/// The depth is that of the first surface opaque enough to have one.
SampleResult SampleBuffer::composite(size_t index) {
  const Sample& sample = samples_[index];
  scratch_.clear();
  for (uint32_t f = sample.fragments; f != kNone; f = fragments_[f].next)
    if (fragments_[f].z < sample.z) scratch_.push_back(&fragments_[f]);
  std::sort(scratch_.begin(), scratch_.end(), [](const Fragment* a, const Fragment* b) {
    return a->z != b->z ? a->z < b->z : a->order < b->order;
  });
  SampleResult out;
  Color C(0.0f), O(0.0f), through(1.0f);
  auto add = [&](Color Ci, Color Oi, bool matte) {
    if (!matte) {
      C += through * Ci;
      O += through * Oi;
    }
    through *= Color(1.0f) - Oi;
  };
  auto own_aov = sample_aov_.begin() + static_cast<std::ptrdiff_t>(index * aovs_);
  bool seen = false, closed = false;
  for (const Fragment* f : scratch_) {
    if (!seen && !f->matte) {
      seen = true;
      std::copy_n(fragment_aov_.begin() + static_cast<std::ptrdiff_t>(f->order * aovs_), aovs_, own_aov);
    }
    if (!f->matte && reaches(f->Oi, settings_.depth_threshold))
      out.channels[Image::kZ] = std::min(out.channels[Image::kZ], f->z);
    add(f->Ci, f->Oi, f->matte);
    closed = reaches(Color(1.0f) - through, settings_.opacity_threshold);
    if (closed) break;
  }
  if (!closed && sample.z < kInfinity) {
    add(sample.Ci, sample.Oi, sample.matte);
    if (sample.matte && !seen) std::fill_n(own_aov, aovs_, 0.0f);
  }
  if (sample.z < kInfinity && !sample.matte) {
    float z = sample.z;
    if (midpoint_ && sample.second < kInfinity) z = 0.5f * (z + sample.second);
    out.channels[Image::kZ] = std::min(out.channels[Image::kZ], z);
  }
  for (int c = 0; c < 3; ++c) {
    out.channels[Image::kCi + c] = C[c];
    out.channels[Image::kOi + c] = O[c];
  }
  out.channels[Image::kAlpha] = (O.x + O.y + O.z) / 3;
  return out;
}

void SampleBuffer::finish(Image& image) {
  resolve_solid();
  std::vector<SampleResult> results(samples_.size());
  for (size_t i = 0; i < samples_.size(); ++i)
    results[i] = composite(i);
  reconstruct(settings_.reconstruction, settings_.size, rect_, covered_, pattern_, results, sample_aov_,
              image);
}

} // namespace render
