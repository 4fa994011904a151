// Layers of samples, and compositing.
#include "render/hider/sample_layers.h"

#include "render/hider/quad_hits.h"

#include <algorithm>

namespace render {

namespace {

bool reaches(const Color& opacity, const Color& threshold) {
  return opacity.x >= threshold.x && opacity.y >= threshold.y && opacity.z >= threshold.z;
}

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

Color colour_at(const float* planes) {
  return {planes[0], planes[1], planes[2]};
}

} // namespace

SampleLayers::SampleLayers(const LayerSettings& settings)
    : settings_(settings), planes_(Image::kAov + settings.aovs) {}

void SampleLayers::begin(size_t count) {
  count_ = open_ = count;
  farthest_ = kInfinity;
  witness_ = 0;
  const size_t size = count + SampleField::kPadding;
  for (size_t c = 0; c < planes_.size(); ++c) // opacities: see make_layers()
    if (c < Image::kOi || c > Image::kAlpha) planes_[c].assign(size, c == Image::kZ ? kInfinity : 0.0f);
  if (settings_.midpoint) second_.assign(size, kInfinity);
  plain_ = true;
  fragments_.clear();
  looks_.clear();
}

void SampleLayers::painted(size_t count) {
  open_ -= count;
}

void SampleLayers::make_layers() {
  if (!plain_) return;
  plain_ = false;
  for (int c = Image::kOi; c <= Image::kAlpha; ++c)
    planes_[static_cast<size_t>(c)].assign(count_ + SampleField::kPadding, 1.0f);
  matte_.assign(count_ + SampleField::kPadding, 0.0f);
  first_.assign(count_, kNone);
}

bool SampleLayers::hides_what_is_behind(const Color& opacity) const {
  return reaches(opacity, settings_.opacity_threshold);
}

void SampleLayers::set(size_t sample, int channel, const Color& c) {
  for (int i = 0; i < 3; ++i)
    planes_[static_cast<size_t>(channel + i)][sample] = c[i];
}

void SampleLayers::set_variables(size_t sample, const float* values) {
  for (size_t k = 0; k < settings_.aovs; ++k)
    planes_[Image::kAov + k][sample] = values[k];
}

void SampleLayers::cover(size_t sample, float z, const SampleSurface& surface) {
  float& nearest = planes_[Image::kZ][sample];
  float& limit = settings_.midpoint ? second_[sample] : nearest;
  const bool was_open = limit == kInfinity, in_front = z < nearest;
  if (settings_.midpoint) limit = std::min(limit, std::max(z, nearest));
  if (in_front) nearest = z;
  if (was_open && limit < kInfinity) --open_;
  if (!in_front) return;
  set(sample, Image::kCi, surface.Ci);
  set(sample, Image::kOi, surface.Oi);
  matte_[sample] = surface.matte ? 1.0f : 0.0f;
  set_variables(sample, surface.aov);
}

uint32_t SampleLayers::keep(const SampleSurface& s) {
  const size_t each = kVariables + settings_.aovs, number = looks_.size() / each;
  looks_.resize(looks_.size() + each);
  float* out = looks_.data() + number * each;
  for (int c = 0; c < 3; ++c) {
    out[Image::kCi + c] = s.Ci[c];
    out[Image::kOi + c] = s.Oi[c];
  }
  out[kMatte] = s.matte ? 1.0f : 0.0f;
  std::copy_n(s.aov, settings_.aovs, out + kVariables);
  return static_cast<uint32_t>(number);
}

bool SampleLayers::hides(float z) const {
  if (open_ > 0) return false;
  if (z > farthest_) return true;
  const std::span<const float> all(limits(), count_);
  if (all[witness_] >= z) return false;
  constexpr size_t kBlock = 256;
  float farthest = 0;
  for (size_t k = 0; k < count_; k += kBlock) {
    const std::span<const float> block = all.subspan(k, std::min(kBlock, count_ - k));
    const float most = greatest(block);
    if (!(z > most)) {
      witness_ = static_cast<size_t>(std::find(block.begin(), block.end(), most) - all.begin());
      return false;
    }
    farthest = std::max(farthest, most);
  }
  farthest_ = farthest;
  return true;
}

bool SampleLayers::hides(const SampleWindow& window, size_t width, float z) const {
  const float* row = limits() + window.j0 * width + window.i0;
  for (size_t j = window.j0; j < window.j1; ++j, row += width)
    if (!(z > greatest({row, window.i1 - window.i0}))) return false;
  return true;
}

/// Those of a sample that are in front of what is opaque, front to back; of the same depth, as they came.
void SampleLayers::sort_fragments(size_t sample) {
  const float nearest = depths()[sample];
  in_order_.clear();
  for (uint32_t f = first_[sample]; f != kNone; f = fragments_[f].next)
    if (fragments_[f].z < nearest) in_order_.push_back(fragments_[f]);
  std::reverse(in_order_.begin(), in_order_.end());
  constexpr size_t kFew = 32;
  if (in_order_.size() > kFew) {
    std::stable_sort(in_order_.begin(), in_order_.end(),
                     [](const Fragment& a, const Fragment& b) { return a.z < b.z; });
    return;
  }
  // Often they are in order already.
  for (size_t i = 1; i < in_order_.size(); ++i) {
    const Fragment f = in_order_[i];
    size_t k = i;
    for (; k > 0 && f.z < in_order_[k - 1].z; --k)
      in_order_[k] = in_order_[k - 1];
    in_order_[k] = f;
  }
}

/// Front to back: C += T Ci, T *= 1 - Oi for each component, until the opacity threshold (RISpec 3.2, 4.2).
/// The depth is that of the first surface opaque enough to have one.
void SampleLayers::composite(size_t sample) {
  const bool matte_behind = matte_[sample] != 0;
  const float nearest = depths()[sample], depth_behind = opaque_depth(sample);
  sort_fragments(sample);
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
  for (const Fragment& f : in_order_) {
    const float* values = look(f.look);
    const Color Ci = colour_at(values + Image::kCi), Oi = colour_at(values + Image::kOi);
    const bool matte = values[kMatte] != 0;
    if (!seen && !matte) {
      seen = true;
      set_variables(sample, values + kVariables);
    }
    if (!matte && reaches(Oi, settings_.depth_threshold)) depth = std::min(depth, f.z);
    add(Ci, Oi, matte);
    closed = hides_what_is_behind(Color(1.0f) - through);
    if (closed) break;
  }
  if (!closed && nearest < kInfinity) {
    Color Ci, Oi;
    for (int c = 0; c < 3; ++c) {
      Ci[c] = plane(Image::kCi + c)[sample];
      Oi[c] = plane(Image::kOi + c)[sample];
    }
    add(Ci, Oi, matte_behind);
    if (matte_behind && !seen)
      for (size_t k = 0; k < settings_.aovs; ++k)
        planes_[Image::kAov + k][sample] = 0;
  }
  if (!matte_behind) depth = std::min(depth, depth_behind);
  planes_[Image::kZ][sample] = depth;
  set(sample, Image::kCi, C);
  set(sample, Image::kOi, O);
  planes_[Image::kAlpha][sample] = (O.x + O.y + O.z) / 3;
}

/// The depth of what is opaque; with midpoints, half way to what is behind it.
float SampleLayers::opaque_depth(size_t sample) const {
  const float nearest = depths()[sample];
  return settings_.midpoint && second_[sample] < kInfinity ? 0.5f * (nearest + second_[sample]) : nearest;
}

std::span<const SampleSpan> SampleLayers::find_filled(size_t width) {
  auto is_empty = [&](size_t k) { return depths()[k] == kInfinity && (plain_ || first_[k] == kNone); };
  filled_.assign(count_ / width, {});
  for (size_t j = 0; j < filled_.size(); ++j) {
    SampleSpan row{0, width};
    while (row.begin < row.end && is_empty(j * width + row.begin))
      ++row.begin;
    while (row.begin < row.end && is_empty(j * width + row.end - 1))
      --row.end;
    filled_[j] = row;
  }
  return filled_;
}

/// What there are no layers over is soon done: only the coverage is left to find out.
void SampleLayers::composite() {
  std::vector<float>&depth = planes_[Image::kZ], &alpha = planes_[Image::kAlpha];
  alpha.resize(depth.size());
  if (plain_) {
    for (size_t k = 0; k < count_; ++k)
      alpha[k] = depth[k] < kInfinity ? 1.0f : 0.0f;
    return;
  }
  find_alpha(std::span(depth.data(), count_), plane(Image::kOi), plane(Image::kOi + 1), plane(Image::kOi + 2),
             alpha.data());
  for (size_t k = 0; k < count_; ++k)
    if (first_[k] != kNone || matte_[k] != 0)
      composite(k);
    else if (settings_.midpoint)
      depth[k] = opaque_depth(k);
}

std::span<const float* const> SampleLayers::finished() {
  finished_.clear();
  for (const std::vector<float>& plane : planes_)
    finished_.push_back(plane.data());
  for (int c = Image::kOi; plain_ && c < Image::kAlpha; ++c)
    finished_[static_cast<size_t>(c)] = finished_[Image::kAlpha];
  return finished_;
}

} // namespace render
