// Weighted means of samples, always summed in the order of the frame's rows: a pixel does not depend on the
// bucket that makes it.
#include "render/hider/reconstruct.h"

#include "render/hider/window_weights.h"

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

/// The cells, of `density` a pixel, that have points less than half a width from `centre`.
void reach(float centre, float width, int density, int cells, size_t& from, size_t& to) {
  auto d = static_cast<float>(density);
  from = static_cast<size_t>(std::max(0.0f, (centre - width / 2) * d));
  to = static_cast<size_t>(std::clamp(std::ceil((centre + width / 2) * d), 0.0f, static_cast<float>(cells)));
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
  struct Plan {
    PixelFilter filter;
    std::vector<Term> terms;
  };
  /// `standard`: the image's first channels, too. That of z is written over later.
  template <bool standard> void filter(const Plan& plan);
  void add(const Plan& plan, size_t sample, float weight, float* pixel) const;
  template <bool standard> void plain_mean(const Plan& plan, int x, int y);
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
  std::vector<Plan> plans_;
};

void Reconstruction::run() {
  plans_.push_back({settings_.filter, {}});
  add_aovs();
  if (settings_.subpixel) {
    copy_samples();
    return;
  }
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x)
      std::fill_n(image_.pixel(x, y), image_.channels, 0.0f);
  filter<true>(plans_[0]);
  for (size_t i = 1; i < plans_.size(); ++i)
    filter<false>(plans_[i]);
  for (int y = rect_.y0; y < rect_.y1; ++y)
    for (int x = rect_.x0; x < rect_.x1; ++x)
      image_.pixel(x, y)[Image::kZ] = depth(x, y);
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
    case Source::kColor: term.samples = results_[0].channels; break;
    case Source::kOpacity: term.samples = results_[0].channels + Image::kOi; break;
    case Source::kAlpha: term.samples = results_[0].channels + Image::kAlpha; break;
    case Source::kDepth:
      if (!settings_.subpixel) continue; // depths are not blended
      term.samples = results_[0].channels + Image::kZ;
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

void Reconstruction::add(const Plan& plan, size_t sample, float weight, float* pixel) const {
  for (const Term& t : plan.terms)
    for (int c = 0; c < t.count; ++c)
      pixel[t.to + c] += weight * t.samples[sample * t.stride + static_cast<size_t>(c)];
}

template <bool standard> void Reconstruction::filter(const Plan& plan) {
  const PixelFilter& filter = plan.filter;
  WindowWeights weights(filter);
  auto width = static_cast<size_t>(pattern_.width());
  SampleWindow window;
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    float cy = static_cast<float>(y) + 0.5f;
    reach(cy - static_cast<float>(covered_.y0), filter.ywidth, size_.ysamples, pattern_.height(), window.j0,
          window.j1);
    for (int x = rect_.x0; x < rect_.x1; ++x) {
      float cx = static_cast<float>(x) + 0.5f;
      reach(cx - static_cast<float>(covered_.x0), filter.xwidth, size_.xsamples, pattern_.width(), window.i0,
            window.i1);
      const float* weight = weights.at({cx, cy}, pattern_, window);
      // Summed here and not in the image, to stay in registers.
      float sum[Image::kAov] = {};
      float* p = image_.pixel(x, y);
      float total = 0;
      for (size_t j = window.j0; j < window.j1; ++j)
        for (size_t k = j * width + window.i0, end = j * width + window.i1; k < end; ++k, ++weight) {
          float w = *weight;
          total += w;
          if constexpr (standard)
            for (int c = 0; c < Image::kAov; ++c)
              sum[c] += w * results_[k].channels[c];
          add(plan, k, w, p);
        }
      // A filter so narrow that it missed all samples: the plain mean of the pixel.
      if (total == 0) {
        plain_mean<standard>(plan, x, y);
        continue;
      }
      for (int c = 0; standard && c < Image::kAov; ++c)
        p[c] = sum[c] / total;
      for (const Term& t : plan.terms)
        for (int c = 0; c < t.count; ++c)
          p[t.to + c] /= total;
    }
  }
}

template <bool standard> void Reconstruction::plain_mean(const Plan& plan, int x, int y) {
  float w = 1 / static_cast<float>(size_.xsamples * size_.ysamples);
  float* p = image_.pixel(x, y);
  std::fill_n(p, standard ? Image::kAov : 0, 0.0f);
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i) {
      size_t k = sample(x, y, i, j);
      for (int c = 0; standard && c < Image::kAov; ++c)
        p[c] += w * results_[k].channels[c];
      add(plan, k, w, p);
    }
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
      float z = results_[sample(x, y, i, j)].channels[Image::kZ];
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
          std::copy_n(results_[k].channels, Image::kAov, p);
          for (const Plan& plan : plans_)
            for (const Term& t : plan.terms)
              std::copy_n(t.samples + k * t.stride, t.count, p + t.to);
          p[Image::kZ] = std::min(results_[k].channels[Image::kZ], Image::kEmptyDepth);
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
