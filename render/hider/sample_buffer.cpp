// Sampling of micropolygons, compositing, filtering.
#include "render/hider/sample_buffer.h"

#include "render/hider/filter.h"
#include "render/hider/random.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

int margin(float width) {
  return std::max(0, static_cast<int>(std::ceil(width / 2 - 0.5f)));
}

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

struct Triangle {
  Edge ab, bc, ca;
  Triangle(Vec2 a, Vec2 b, Vec2 c) : ab(a, b), bc(b, c), ca(c, a) {}
  /// Barycentric weights of a, b, c when p is inside.
  bool contains(Vec2 p, float (&weights)[3]) const {
    float e[3] = {bc.value(p), ca.value(p), ab.value(p)};
    bool l0 = bc.left(e[0]), l1 = ca.left(e[1]), l2 = ab.left(e[2]);
    if (l0 != l1 || l1 != l2) return false;
    float sum = 0;
    for (float& x : e)
      sum += x = std::abs(x);
    if (!(sum > 0)) return false;
    for (int i = 0; i < 3; ++i)
      weights[i] = e[i] / sum;
    return true;
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

SamplingSettings SamplingSettings::from(const Options& o, int aov_floats) {
  return {o.xsamples,          o.ysamples,   o.jitter,    o.filter,
          o.opacity_threshold, o.near_plane, o.far_plane, aov_floats};
}

int SamplingSettings::xmargin() const {
  return margin(filter.xwidth);
}
int SamplingSettings::ymargin() const {
  return margin(filter.ywidth);
}

SampleBuffer::SampleBuffer(PixelRect rect, const SamplingSettings& settings)
    : settings_(settings), rect_(rect) {
  int mx = settings.xmargin(), my = settings.ymargin();
  covered_ = {rect.x0 - mx, rect.y0 - my, rect.x1 + mx, rect.y1 + my};
  width_ = covered_.width() * settings.xsamples;
  height_ = covered_.height() * settings.ysamples;
  samples_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
  sample_aov_.resize(samples_.size() * static_cast<size_t>(settings.aov_floats));
  open_ = samples_.size();
  auto xs = static_cast<float>(settings.xsamples), ys = static_cast<float>(settings.ysamples);
  size_t k = 0;
  for (int j = 0; j < height_; ++j)
    for (int i = 0; i < width_; ++i, ++k) {
      // The cell's place in the frame, not in the bucket, decides where the sample lies.
      int x = covered_.x0 * settings.xsamples + i, y = covered_.y0 * settings.ysamples + j;
      uint64_t h = hash_of(x, y, kJitter);
      float dx = settings.jitter ? upper_unit(h) : 0.5f, dy = settings.jitter ? lower_unit(h) : 0.5f;
      samples_[k].at = {(static_cast<float>(x) + dx) / xs, (static_cast<float>(y) + dy) / ys};
    }
}

void SampleBuffer::draw(const ShadedGrid& grid) {
  auto nu = static_cast<size_t>(grid.nu), nv = static_cast<size_t>(grid.nv);
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m)
      if (!grid.hidden[m]) draw_micropolygon(grid, j * nu + i);
}

void SampleBuffer::draw_micropolygon(const ShadedGrid& grid, size_t k) {
  auto nu = static_cast<size_t>(grid.nu);
  size_t corner[4] = {k, k + 1, k + nu, k + nu + 1};
  Vec2 p[4];
  Vec2 low(kInfinity), high(-kInfinity);
  for (int i = 0; i < 4; ++i) {
    p[i] = Vec2(grid.position[corner[i]]);
    low = glm::min(low, p[i]);
    high = glm::max(high, p[i]);
  }
  auto xs = static_cast<float>(settings_.xsamples), ys = static_cast<float>(settings_.ysamples);
  auto x0 = static_cast<float>(covered_.x0), y0 = static_cast<float>(covered_.y0);
  auto cells = [](float from, float to, int size, int& begin, int& end) {
    begin = static_cast<int>(std::clamp(std::floor(from), 0.0f, static_cast<float>(size)));
    end = static_cast<int>(std::clamp(std::floor(to) + 1, 0.0f, static_cast<float>(size)));
  };
  int i0, i1, j0, j1;
  cells((low.x - x0) * xs, (high.x - x0) * xs, width_, i0, i1);
  cells((low.y - y0) * ys, (high.y - y0) * ys, height_, j0, j1);
  if (i0 >= i1 || j0 >= j1) return;
  Triangle first(p[0], p[1], p[3]), second(p[0], p[3], p[2]);
  float weights[3];
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      size_t index = static_cast<size_t>(j) * static_cast<size_t>(width_) + static_cast<size_t>(i);
      Sample& s = samples_[index];
      if (first.contains(s.at, weights)) hit(grid, s, index, {corner[0], corner[1], corner[3]}, weights);
      // A folded micropolygon may cover a sample twice; it counts once.
      else if (second.contains(s.at, weights))
        hit(grid, s, index, {corner[0], corner[3], corner[2]}, weights);
    }
}

void SampleBuffer::hit(const ShadedGrid& grid, Sample& sample, size_t index, const size_t (&corners)[3],
                       const float (&weights)[3]) {
  const auto& p = grid.position;
  float z = blend(p[corners[0]].z, p[corners[1]].z, p[corners[2]].z, weights);
  if (z >= sample.z || z < settings_.near_plane || z > settings_.far_plane) return;
  // corners[0] is the micropolygon's own corner, whose colour it has throughout without smooth shading.
  Color Ci = grid.Ci[corners[0]], Oi = grid.Oi[corners[0]];
  if (grid.smooth) {
    Ci = blend(Ci, grid.Ci[corners[1]], grid.Ci[corners[2]], weights);
    Oi = blend(Oi, grid.Oi[corners[1]], grid.Oi[corners[2]], weights);
  }
  auto aovs = static_cast<size_t>(settings_.aov_floats);
  const float* aov = grid.aov.data() + corners[0] * aovs;
  if (reaches(Oi, settings_.opacity_threshold)) {
    if (sample.z == kInfinity) --open_;
    sample.z = z;
    sample.Ci = Ci;
    sample.Oi = Oi;
    sample.matte = grid.matte;
    std::copy_n(aov, aovs, sample_aov_.begin() + static_cast<std::ptrdiff_t>(index * aovs));
    farthest_known_ = false;
    return;
  }
  if (Ci == Color(0.0f) && Oi == Color(0.0f)) return; // not there at all
  auto order = static_cast<uint32_t>(fragments_.size());
  fragments_.push_back({Ci, Oi, z, sample.fragments, order, grid.matte});
  fragment_aov_.insert(fragment_aov_.end(), aov, aov + aovs);
  sample.fragments = order;
}

float SampleBuffer::farthest() const {
  if (open_ > 0) return kInfinity;
  if (!farthest_known_) {
    farthest_ = 0;
    for (const Sample& s : samples_)
      farthest_ = std::max(farthest_, s.z);
    farthest_known_ = true;
  }
  return farthest_;
}

/// Front to back: C += T Ci, T *= 1 - Oi for each component, until the opacity threshold (RISpec 3.2, 4.2).
SampleBuffer::Result SampleBuffer::composite(size_t index) {
  const Sample& sample = samples_[index];
  scratch_.clear();
  for (uint32_t f = sample.fragments; f != kNone; f = fragments_[f].next)
    if (fragments_[f].z < sample.z) scratch_.push_back(&fragments_[f]);
  std::sort(scratch_.begin(), scratch_.end(), [](const Fragment* a, const Fragment* b) {
    return a->z != b->z ? a->z < b->z : a->order < b->order;
  });
  Result out;
  Color through(1.0f);
  auto add = [&](Color Ci, Color Oi, bool matte) {
    if (!matte) {
      out.Ci += through * Ci;
      out.Oi += through * Oi;
    }
    through *= Color(1.0f) - Oi;
  };
  auto aovs = static_cast<size_t>(settings_.aov_floats);
  auto keep_first = [&](const Fragment* f) {
    if (aovs == 0) return;
    auto order = static_cast<std::ptrdiff_t>(f->order) * static_cast<std::ptrdiff_t>(aovs);
    std::copy_n(fragment_aov_.begin() + order, aovs,
                sample_aov_.begin() + static_cast<std::ptrdiff_t>(index * aovs));
  };
  for (const Fragment* f : scratch_) {
    if (out.z == kInfinity && !f->matte) {
      out.z = f->z;
      keep_first(f);
    }
    add(f->Ci, f->Oi, f->matte);
    if (reaches(Color(1.0f) - through, settings_.opacity_threshold)) return out;
  }
  if (sample.z < kInfinity) {
    add(sample.Ci, sample.Oi, sample.matte);
    if (!sample.matte)
      out.z = std::min(out.z, sample.z);
    else if (out.z == kInfinity)
      std::fill_n(sample_aov_.begin() + static_cast<std::ptrdiff_t>(index * aovs), aovs, 0.0f);
  }
  return out;
}

void SampleBuffer::finish(Image& image) {
  results_.resize(samples_.size());
  for (size_t i = 0; i < samples_.size(); ++i)
    results_[i] = composite(i);
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x)
      filter_pixel(x, y, image.pixel(x, y));
}

void SampleBuffer::filter_pixel(int x, int y, float* out) const {
  const PixelFilter& filter = settings_.filter;
  auto aovs = static_cast<size_t>(settings_.aov_floats);
  float cx = static_cast<float>(x) + 0.5f, cy = static_cast<float>(y) + 0.5f;
  // The pixels the filter reaches: all their samples are looked at, those outside its width weigh nothing.
  int mx = settings_.xmargin(), my = settings_.ymargin();
  std::fill_n(out, static_cast<size_t>(Image::kAov) + aovs, 0.0f);
  out[Image::kZ] = Image::kEmptyDepth;
  float total = 0;
  auto accumulate = [&](int from_x, int to_x, int from_y, int to_y, bool even) {
    for (int j = (from_y - covered_.y0) * settings_.ysamples; j < (to_y - covered_.y0) * settings_.ysamples;
         ++j)
      for (int i = (from_x - covered_.x0) * settings_.xsamples; i < (to_x - covered_.x0) * settings_.xsamples;
           ++i) {
        size_t k = static_cast<size_t>(j) * static_cast<size_t>(width_) + static_cast<size_t>(i);
        const Sample& s = samples_[k];
        float w = even ? 1 : filter_weight(filter, s.at.x - cx, s.at.y - cy);
        if (w == 0) continue;
        total += w;
        for (int c = 0; c < 3; ++c) {
          out[Image::kCi + c] += w * results_[k].Ci[c];
          out[Image::kOi + c] += w * results_[k].Oi[c];
        }
        for (size_t c = 0; c < aovs; ++c)
          out[static_cast<size_t>(Image::kAov) + c] += w * sample_aov_[k * aovs + c];
      }
  };
  accumulate(x - mx, x + mx + 1, y - my, y + my + 1, false);
  // A filter so narrow that it missed all samples: the plain mean of the pixel.
  if (total == 0) accumulate(x, x + 1, y, y + 1, true);
  for (int c = 0; c < 6; ++c)
    out[c] /= total;
  for (size_t c = 0; c < aovs; ++c)
    out[static_cast<size_t>(Image::kAov) + c] /= total;
  out[Image::kAlpha] = (out[3] + out[4] + out[5]) / 3;
  // Depths are not blended: the nearest of the pixel's own samples.
  for (int j = 0; j < settings_.ysamples; ++j)
    for (int i = 0; i < settings_.xsamples; ++i) {
      int row = (y - covered_.y0) * settings_.ysamples + j,
          column = (x - covered_.x0) * settings_.xsamples + i;
      size_t k = static_cast<size_t>(row) * static_cast<size_t>(width_) + static_cast<size_t>(column);
      out[Image::kZ] = std::min(out[Image::kZ], results_[k].z);
    }
}

} // namespace render
