// Weighted means of samples. Every sample is spread over the pixels its filter reaches, in the order of the
// frame's rows: a pixel's sum has the same order whichever bucket makes it.
#include "render/hider/reconstruct.h"

#include "render/hider/filter.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

int margin(float width) {
  return std::max(0, static_cast<int>(std::ceil(width / 2 - 0.5f)));
}

/// Values that go through one filter: where they are among those of a sample, and where in a pixel.
struct Term {
  const float* samples;
  size_t stride;
  int count, to;
};

/// The pixels from `from` to `to` whose centres are within half a width of `at`.
void reach(float at, float width, int low, int high, int& from, int& to) {
  from = std::max(low, static_cast<int>(std::ceil(at - width / 2 - 0.5f)));
  to = std::min(high, static_cast<int>(std::floor(at + width / 2 - 0.5f)) + 1);
}

class Reconstruction {
public:
  Reconstruction(const ReconstructionSettings& settings, const SampleGridSize& size, PixelRect rect,
                 PixelRect covered, const SamplePattern& pattern, std::span<const SampleResult> results,
                 std::span<const float> aov, Image& image)
      : settings_(settings), size_(size), rect_(rect), covered_(covered), pattern_(pattern),
        results_(results), aov_(aov), image_(image) {}

  void run();

private:
  void add_aovs();
  void filter(const PixelFilter& filter, std::span<const Term> terms);
  void plain_mean(int x, int y, std::span<const Term> terms);
  float depth(int x, int y) const;
  void copy_samples();
  size_t sample(int x, int y, int i, int j) const {
    int row = (y - covered_.y0) * size_.ysamples + j, column = (x - covered_.x0) * size_.xsamples + i;
    return static_cast<size_t>(row) * static_cast<size_t>(pattern_.width()) + static_cast<size_t>(column);
  }

  const ReconstructionSettings& settings_;
  const SampleGridSize& size_;
  PixelRect rect_, covered_;
  const SamplePattern& pattern_;
  std::span<const SampleResult> results_;
  std::span<const float> aov_;
  Image& image_;
  struct Plan {
    PixelFilter filter;
    std::vector<Term> terms;
  };
  std::vector<Plan> plans_;
  std::vector<float> total_, wx_;
};

void Reconstruction::run() {
  constexpr size_t kStride = sizeof(SampleResult) / sizeof(float);
  plans_.push_back({settings_.filter, {{results_[0].Ci, kStride, 7, Image::kCi}}});
  add_aovs();
  if (settings_.subpixel) {
    copy_samples();
    return;
  }
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x) {
      float* p = image_.pixel(x, y);
      std::fill_n(p, image_.channels, 0.0f);
      p[Image::kZ] = depth(x, y);
    }
  for (const Plan& plan : plans_)
    filter(plan.filter, plan.terms);
  for (const AovChannel& a : settings_.aovs)
    if (a.source == AovChannel::Source::kDepth)
      for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int x = rect_.x0; x < rect_.x1; ++x)
          image_.pixel(x, y)[Image::kAov + a.first] = image_.pixel(x, y)[Image::kZ];
}

void Reconstruction::add_aovs() {
  constexpr size_t kStride = sizeof(SampleResult) / sizeof(float);
  using Source = AovChannel::Source;
  for (const AovChannel& a : settings_.aovs) {
    Term term{nullptr, kStride, a.components, Image::kAov + a.first};
    switch (a.source) {
    case Source::kVariable:
      term.samples = aov_.data() + a.first;
      term.stride = settings_.aov_floats();
      break;
    case Source::kColor: term.samples = results_[0].Ci; break;
    case Source::kOpacity: term.samples = results_[0].Oi; break;
    case Source::kAlpha: term.samples = &results_[0].alpha; break;
    case Source::kDepth:
      if (!settings_.subpixel) continue; // depths are not blended
      term.samples = &results_[0].z;
      break;
    }
    const PixelFilter& f = a.filter ? *a.filter : settings_.filter;
    auto same = [&](const Plan& p) {
      return p.filter.kind == f.kind && p.filter.xwidth == f.xwidth && p.filter.ywidth == f.ywidth;
    };
    auto plan = std::find_if(plans_.begin(), plans_.end(), same);
    if (plan == plans_.end()) plan = plans_.insert(plan, {f, {}});
    plan->terms.push_back(term);
  }
}

void Reconstruction::filter(const PixelFilter& filter, std::span<const Term> terms) {
  bool separable = is_separable(filter.kind);
  auto width = static_cast<size_t>(rect_.width());
  total_.assign(width * static_cast<size_t>(rect_.height()), 0.0f);
  for (size_t k = 0; k < results_.size(); ++k) {
    Vec2 at = pattern_.at(k);
    int x0, x1, y0, y1;
    reach(at.x, filter.xwidth, rect_.x0, rect_.x1, x0, x1);
    reach(at.y, filter.ywidth, rect_.y0, rect_.y1, y0, y1);
    if (x0 >= x1) continue;
    if (separable) {
      wx_.clear();
      for (int x = x0; x < x1; ++x)
        wx_.push_back(axis_weight(filter.kind, at.x - (static_cast<float>(x) + 0.5f), filter.xwidth));
    }
    for (int y = y0; y < y1; ++y) {
      float dy = at.y - (static_cast<float>(y) + 0.5f);
      float wy = separable ? axis_weight(filter.kind, dy, filter.ywidth) : 0;
      float* p = image_.pixel(x0, y);
      float* total = &total_[static_cast<size_t>(y - rect_.y0) * width + static_cast<size_t>(x0 - rect_.x0)];
      for (int x = x0; x < x1; ++x, p += image_.channels, ++total) {
        float w = separable ? wx_[static_cast<size_t>(x - x0)] * wy
                            : filter_weight(filter, at.x - (static_cast<float>(x) + 0.5f), dy);
        *total += w;
        for (const Term& t : terms)
          for (int c = 0; c < t.count; ++c)
            p[t.to + c] += w * t.samples[k * t.stride + static_cast<size_t>(c)];
      }
    }
  }
  size_t i = 0;
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x, ++i) {
      // A filter so narrow that it missed all samples: the plain mean of the pixel.
      if (total_[i] == 0) plain_mean(x, y, terms);
      float divisor = total_[i] == 0 ? 1 : total_[i];
      for (const Term& t : terms)
        for (int c = 0; c < t.count; ++c)
          image_.pixel(x, y)[t.to + c] /= divisor;
    }
}

void Reconstruction::plain_mean(int x, int y, std::span<const Term> terms) {
  float w = 1 / static_cast<float>(size_.xsamples * size_.ysamples);
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i)
      for (const Term& t : terms)
        for (int c = 0; c < t.count; ++c)
          image_.pixel(x, y)[t.to + c] +=
              w * t.samples[sample(x, y, i, j) * t.stride + static_cast<size_t>(c)];
}

/// From the pixel's own samples: those without a surface do not count unless all are so.
float Reconstruction::depth(int x, int y) const {
  bool farthest = settings_.depth_filter == DepthFilter::kMax;
  bool mean = settings_.depth_filter == DepthFilter::kAverage;
  float best = kInfinity, most = -kInfinity;
  double sum = 0;
  int count = 0;
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i) {
      float z = results_[sample(x, y, i, j)].z;
      if (z == kInfinity) continue;
      best = std::min(best, z);
      most = std::max(most, z);
      sum += static_cast<double>(z);
      ++count;
    }
  if (count == 0) return Image::kEmptyDepth;
  if (mean) return static_cast<float>(sum / count);
  return farthest ? most : best;
}

void Reconstruction::copy_samples() {
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x)
      for (int j = 0; j < size_.ysamples; ++j)
        for (int i = 0; i < size_.xsamples; ++i) {
          size_t k = sample(x, y, i, j);
          float* p = image_.pixel(x * size_.xsamples + i, y * size_.ysamples + j);
          for (const Plan& plan : plans_)
            for (const Term& t : plan.terms)
              std::copy_n(t.samples + k * t.stride, t.count, p + t.to);
          p[Image::kZ] = std::min(results_[k].z, Image::kEmptyDepth);
        }
}

} // namespace

size_t ReconstructionSettings::aov_floats() const {
  size_t sum = 0;
  for (const AovChannel& a : aovs)
    sum += static_cast<size_t>(a.components);
  return sum;
}

int ReconstructionSettings::xmargin() const {
  if (subpixel) return 0;
  int out = margin(filter.xwidth);
  for (const AovChannel& a : aovs)
    if (a.filter) out = std::max(out, margin(a.filter->xwidth));
  return out;
}

int ReconstructionSettings::ymargin() const {
  if (subpixel) return 0;
  int out = margin(filter.ywidth);
  for (const AovChannel& a : aovs)
    if (a.filter) out = std::max(out, margin(a.filter->ywidth));
  return out;
}

void reconstruct(const ReconstructionSettings& settings, const SampleGridSize& size, PixelRect rect,
                 PixelRect covered, const SamplePattern& pattern, std::span<const SampleResult> results,
                 std::span<const float> aov, Image& image) {
  Reconstruction(settings, size, rect, covered, pattern, results, aov, image).run();
}

} // namespace render
