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
  Plan& standard = plans_.emplace_back(settings_.filter, WindowWeights(settings_.filter, size_));
  // Depths are not blended.
  for (size_t c = 0; c < Image::kZ; ++c)
    standard.terms.push_back({c, c});
  plan_aovs();
}

void Reconstructor::plan_aovs() {
  using Source = AovChannel::Source;
  for (const AovChannel& a : settings_.aovs) {
    const auto channel = static_cast<size_t>(Image::kAov + a.first);
    size_t plane = channel;
    switch (a.source) {
    case Source::kVariable: break;
    case Source::kColor: plane = Image::kCi; break;
    case Source::kOpacity: plane = Image::kOi; break;
    case Source::kAlpha: plane = Image::kAlpha; break;
    case Source::kDepth: continue;
    }
    const PixelFilter& f = a.filter ? *a.filter : settings_.filter;
    auto same = [&](const Plan& p) {
      return p.filter.kind == f.kind && p.filter.xwidth == f.xwidth && p.filter.ywidth == f.ywidth;
    };
    auto plan = std::find_if(plans_.begin(), plans_.end(), same);
    if (plan == plans_.end()) plan = plans_.insert(plan, {f, WindowWeights(f, size_), {}});
    for (size_t c = 0; c < static_cast<size_t>(a.components); ++c)
      plan->terms.push_back({plane + c, channel + c});
  }
}

void Reconstructor::run(const BucketSamples& samples, Image& image) {
  if (settings_.subpixel) {
    copy_samples(samples, image);
    return;
  }
  for (Plan& plan : plans_)
    filter(plan, samples, image);
  set_depths(samples, image);
}

void Reconstructor::filter(Plan& plan, const BucketSamples& samples, Image& image) {
  // What several channels share, such as the coverage of what is opaque, is summed once.
  sources_.clear();
  source_of_.clear();
  for (const Term& t : plan.terms) {
    auto source = std::find(sources_.begin(), sources_.end(), samples.planes[t.plane]);
    source_of_.push_back(static_cast<size_t>(source - sources_.begin()));
    if (source == sources_.end()) sources_.push_back(samples.planes[t.plane]);
  }
  while (sources_.size() % FilterWindow::kLanes != 0)
    sources_.push_back(sources_[0]);
  means_.resize(sources_.size());
  const PixelRect& rect = samples.rect;
  const FilterWindow& window = plan.weights.window();
  const auto width = static_cast<std::ptrdiff_t>(samples.pattern.width());
  for (int y = rect.y0; y < rect.y1; ++y) {
    const std::ptrdiff_t row = (y - samples.covered.y0) * size_.ysamples + window.j0;
    const SampleSpan any =
        filled(samples, static_cast<size_t>(row), static_cast<size_t>(row) + window.rows());
    for (int x = rect.x0; x < rect.x1; ++x) {
      float* p = image.pixel(x, y);
      const std::ptrdiff_t column = (x - samples.covered.x0) * size_.xsamples + window.i0;
      if (!any.overlaps(static_cast<size_t>(column), static_cast<size_t>(column) + window.columns())) {
        for (const Term& t : plan.terms)
          p[t.channel] = 0;
        continue;
      }
      const float* weights = plan.weights.at(x, y, samples.pattern);
      // A filter so narrow that it missed all samples: the plain mean of the pixel.
      if (plan.weights.missed_all(weights)) {
        plain_mean(plan, samples, x, y, p);
        continue;
      }
      plan.weights.means(sources_, static_cast<size_t>(row * width + column), static_cast<size_t>(width),
                         weights, means_.data());
      for (size_t t = 0; t < plan.terms.size(); ++t)
        p[plan.terms[t].channel] = means_[source_of_[t]];
    }
  }
}

void Reconstructor::plain_mean(const Plan& plan, const BucketSamples& samples, int x, int y,
                               float* pixel) const {
  const auto width = static_cast<size_t>(samples.pattern.width());
  const auto columns = static_cast<size_t>(size_.xsamples), rows = static_cast<size_t>(size_.ysamples);
  for (const Term& t : plan.terms) {
    const float* first = samples.planes[t.plane] + sample(samples, x, y);
    float sum = 0;
    for (size_t j = 0; j < rows; ++j)
      for (size_t i = 0; i < columns; ++i)
        sum += first[j * width + i];
    pixel[t.channel] = sum / static_cast<float>(rows * columns);
  }
}

void Reconstructor::set_depths(const BucketSamples& samples, Image& image) const {
  const PixelRect& rect = samples.rect;
  const auto width = static_cast<size_t>(samples.pattern.width());
  auto columns = static_cast<size_t>(size_.xsamples), rows = static_cast<size_t>(size_.ysamples);
  for (int y = rect.y0; y < rect.y1; ++y) {
    size_t row = static_cast<size_t>(y - samples.covered.y0) * rows;
    const SampleSpan any = filled(samples, row, row + rows);
    for (int x = rect.x0; x < rect.x1; ++x) {
      size_t column = static_cast<size_t>(x - samples.covered.x0) * columns;
      const float* first = samples.planes[Image::kZ] + row * width + column;
      float z = any.overlaps(column, column + columns) ? depth(first, width) : Image::kEmptyDepth;
      float* p = image.pixel(x, y);
      p[Image::kZ] = z;
      for (const AovChannel& a : settings_.aovs)
        if (a.source == AovChannel::Source::kDepth) p[Image::kAov + a.first] = z;
    }
  }
}

/// From the pixel's own samples, the first at `z`: those without a surface do not count unless all are so.
float Reconstructor::depth(const float* z, size_t width) const {
  const auto columns = static_cast<size_t>(size_.xsamples), rows = static_cast<size_t>(size_.ysamples);
  auto for_each = [&](auto&& f) {
    for (size_t j = 0; j < rows; ++j)
      for (size_t i = 0; i < columns; ++i)
        f(z[j * width + i]);
  };
  float best = kInfinity;
  for_each([&](float at) { best = std::min(best, at); });
  if (best == kInfinity) return Image::kEmptyDepth;
  if (settings_.depth_filter == DepthFilter::kMax) {
    float most = -kInfinity;
    for_each([&](float at) { most = at == kInfinity ? most : std::max(most, at); });
    return most;
  }
  if (settings_.depth_filter == DepthFilter::kAverage) {
    double sum = 0;
    int count = 0;
    for_each([&](float at) {
      if (at == kInfinity) return;
      sum += static_cast<double>(at);
      ++count;
    });
    return static_cast<float>(sum / count);
  }
  return best;
}

void Reconstructor::copy_samples(const BucketSamples& samples, Image& image) const {
  const PixelRect& rect = samples.rect;
  const auto width = static_cast<size_t>(samples.pattern.width());
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      for (int j = 0; j < size_.ysamples; ++j)
        for (int i = 0; i < size_.xsamples; ++i) {
          size_t k = sample(samples, x, y) + static_cast<size_t>(j) * width + static_cast<size_t>(i);
          float* p = image.pixel(x * size_.xsamples + i, y * size_.ysamples + j);
          for (const Plan& plan : plans_)
            for (const Term& t : plan.terms)
              p[t.channel] = samples.planes[t.plane][k];
          p[Image::kZ] = std::min(samples.planes[Image::kZ][k], Image::kEmptyDepth);
          for (const AovChannel& a : settings_.aovs)
            if (a.source == AovChannel::Source::kDepth) p[Image::kAov + a.first] = p[Image::kZ];
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
