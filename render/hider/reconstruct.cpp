// Weighted means of samples, always summed in the order of the frame's rows: a pixel does not depend on the
// bucket that makes it.
#include "render/hider/reconstruct.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

int margin(float width) {
  return std::max(0, static_cast<int>(std::ceil(width / 2 - 0.5f)));
}

/// The cells, of `density` a pixel, that have points less than half a width from `centre`.
void reach(float centre, float width, int density, int cells, size_t& from, size_t& to) {
  auto d = static_cast<float>(density);
  from = static_cast<size_t>(std::max(0.0f, (centre - width / 2) * d));
  to = static_cast<size_t>(std::clamp(std::ceil((centre + width / 2) * d), 0.0f, static_cast<float>(cells)));
}

/// What holds all of the rows from j0 to before j1.
SampleSpan filled(const BucketSamples& samples, size_t j0, size_t j1) {
  SampleSpan out;
  for (size_t j = j0; j < j1; ++j)
    out.add(samples.filled[j]);
  return out;
}

} // namespace

Reconstructor::Reconstructor(const ReconstructionSettings& settings, const SampleGridSize& size)
    : settings_(settings), size_(size) {
  plans_.push_back({settings_.filter, WindowWeights(settings_.filter), {}});
  plan_aovs();
}

void Reconstructor::plan_aovs() {
  constexpr size_t kStride = sizeof(SampleResult) / sizeof(float);
  using Source = AovChannel::Source;
  for (const AovChannel& a : settings_.aovs) {
    Term term{false, 0, kStride, a.components, Image::kAov + a.first};
    switch (a.source) {
    case Source::kVariable:
      term.variable = true;
      term.first = static_cast<size_t>(a.first);
      term.stride = settings_.aov_floats();
      break;
    case Source::kColor: term.first = Image::kCi; break;
    case Source::kOpacity: term.first = Image::kOi; break;
    case Source::kAlpha: term.first = Image::kAlpha; break;
    case Source::kDepth:
      if (!settings_.subpixel) continue; // depths are not blended
      term.first = Image::kZ;
      break;
    }
    const PixelFilter& f = a.filter ? *a.filter : settings_.filter;
    auto same = [&](const Plan& p) {
      return p.filter.kind == f.kind && p.filter.xwidth == f.xwidth && p.filter.ywidth == f.ywidth;
    };
    auto plan = std::find_if(plans_.begin(), plans_.end(), same);
    if (plan == plans_.end()) plan = plans_.insert(plan, {f, WindowWeights(f), {}});
    plan->terms.push_back(term);
  }
}

void Reconstructor::run(const BucketSamples& samples, Image& image) {
  if (settings_.subpixel) {
    copy_samples(samples, image);
    return;
  }
  clear(settings_, samples.rect, image);
  filter<true>(plans_[0], samples, image);
  for (size_t i = 1; i < plans_.size(); ++i)
    filter<false>(plans_[i], samples, image);
  set_depths(samples, image);
}

template <bool standard>
void Reconstructor::filter(Plan& plan, const BucketSamples& samples, Image& image) const {
  const PixelFilter& filter = plan.filter;
  const PixelRect &rect = samples.rect, &covered = samples.covered;
  const SamplePattern& pattern = samples.pattern;
  auto width = static_cast<size_t>(pattern.width());
  SampleWindow window;
  for (int y = rect.y0; y < rect.y1; ++y) {
    float cy = static_cast<float>(y) + 0.5f;
    reach(cy - static_cast<float>(covered.y0), filter.ywidth, size_.ysamples, pattern.height(), window.j0,
          window.j1);
    const SampleSpan any = filled(samples, window.j0, window.j1);
    for (int x = rect.x0; x < rect.x1; ++x) {
      float cx = static_cast<float>(x) + 0.5f;
      reach(cx - static_cast<float>(covered.x0), filter.xwidth, size_.xsamples, pattern.width(), window.i0,
            window.i1);
      if (!any.overlaps(window.i0, window.i1)) continue;
      const float* weight = plan.weights.at({cx, cy}, pattern, window);
      // Summed here and not in the image, to stay in registers.
      float sum[Image::kAov] = {};
      float* p = image.pixel(x, y);
      float total = 0;
      for (size_t j = window.j0; j < window.j1; ++j)
        for (size_t k = j * width + window.i0, end = j * width + window.i1; k < end; ++k, ++weight) {
          float w = *weight;
          total += w;
          if constexpr (standard)
            for (int c = 0; c < Image::kAov; ++c)
              sum[c] += w * samples.results[k].channels[c];
          for (const Term& t : plan.terms)
            for (int c = 0; c < t.count; ++c)
              p[t.to + c] += w * t.in(samples)[k * t.stride + static_cast<size_t>(c)];
        }
      // A filter so narrow that it missed all samples: the plain mean of the pixel.
      if (total == 0) {
        plain_mean<standard>(plan, samples, x, y, p);
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

template <bool standard>
void Reconstructor::plain_mean(const Plan& plan, const BucketSamples& samples, int x, int y,
                               float* pixel) const {
  float w = 1 / static_cast<float>(size_.xsamples * size_.ysamples);
  std::fill_n(pixel, standard ? Image::kAov : 0, 0.0f);
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i) {
      size_t k = sample(samples, x, y, i, j);
      for (int c = 0; standard && c < Image::kAov; ++c)
        pixel[c] += w * samples.results[k].channels[c];
      for (const Term& t : plan.terms)
        for (int c = 0; c < t.count; ++c)
          pixel[t.to + c] += w * t.in(samples)[k * t.stride + static_cast<size_t>(c)];
    }
}

void Reconstructor::set_depths(const BucketSamples& samples, Image& image) const {
  const PixelRect& rect = samples.rect;
  auto columns = static_cast<size_t>(size_.xsamples), rows = static_cast<size_t>(size_.ysamples);
  for (int y = rect.y0; y < rect.y1; ++y) {
    size_t row = static_cast<size_t>(y - samples.covered.y0) * rows;
    const SampleSpan any = filled(samples, row, row + rows);
    for (int x = rect.x0; x < rect.x1; ++x) {
      size_t column = static_cast<size_t>(x - samples.covered.x0) * columns;
      float z = any.overlaps(column, column + columns) ? depth(samples, x, y) : Image::kEmptyDepth;
      float* p = image.pixel(x, y);
      p[Image::kZ] = z;
      for (const AovChannel& a : settings_.aovs)
        if (a.source == AovChannel::Source::kDepth) p[Image::kAov + a.first] = z;
    }
  }
}

/// From the pixel's own samples: those without a surface do not count unless all are so.
float Reconstructor::depth(const BucketSamples& samples, int x, int y) const {
  bool farthest = settings_.depth_filter == DepthFilter::kMax;
  bool mean = settings_.depth_filter == DepthFilter::kAverage;
  float best = kInfinity, most = -kInfinity;
  double sum = 0;
  int count = 0;
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i) {
      float z = samples.results[sample(samples, x, y, i, j)].channels[Image::kZ];
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

void Reconstructor::copy_samples(const BucketSamples& samples, Image& image) const {
  const PixelRect& rect = samples.rect;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      for (int j = 0; j < size_.ysamples; ++j)
        for (int i = 0; i < size_.xsamples; ++i) {
          size_t k = sample(samples, x, y, i, j);
          float* p = image.pixel(x * size_.xsamples + i, y * size_.ysamples + j);
          std::copy_n(samples.results[k].channels, Image::kAov, p);
          for (const Plan& plan : plans_)
            for (const Term& t : plan.terms)
              std::copy_n(t.in(samples) + k * t.stride, t.count, p + t.to);
          p[Image::kZ] = std::min(samples.results[k].channels[Image::kZ], Image::kEmptyDepth);
        }
}

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

void clear(const ReconstructionSettings& settings, PixelRect rect, Image& image) {
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      float* p = image.pixel(x, y);
      std::fill_n(p, image.channels, 0.0f);
      p[Image::kZ] = Image::kEmptyDepth;
      for (const AovChannel& a : settings.aovs)
        if (a.source == AovChannel::Source::kDepth) p[Image::kAov + a.first] = Image::kEmptyDepth;
    }
}

} // namespace render
