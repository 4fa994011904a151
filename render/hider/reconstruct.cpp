// Weighted means of samples, always summed in the order of the window's rows: a pixel does not depend on the
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
    : settings_(settings), size_(size), columns_(size), depths_(settings.depth_channels()) {
  Plan& standard = plans_.emplace_back(Plan{settings_.filter, WindowWeights(settings_.filter, size_), {}});
  // Depths are not blended.
  for (size_t c = 0; c < Image::kZ; ++c)
    if (settings_.shown[c]) standard.terms.push_back({c, c});
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
  columns_.begin(samples.covered);
  for (Plan& plan : plans_)
    filter(plan, samples, image);
  set_depths(samples, image);
}

template <class F> void Reconstructor::for_runs(const PixelRect& rect, F&& f) {
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0, end; x < rect.x1; x = end) {
      end = std::min(SampleColumns::block_of(x) + SampleColumns::kBlock, rect.x1);
      f(Run{x, end, y});
    }
}

/// `values`: of the run's block.
void Reconstructor::set(Image& image, const Run& run, size_t channel, const float* values) {
  std::copy(values + (run.x0 - run.block()), values + (run.x1 - run.block()),
            image.row(static_cast<int>(channel), run.x0, run.y));
}

void Reconstructor::filter(Plan& plan, const BucketSamples& samples, Image& image) {
  if (plan.terms.empty()) return;
  // What several channels share, such as the coverage of what is opaque, is summed once.
  sources_.clear();
  source_of_.clear();
  for (const Term& t : plan.terms) {
    const float* plane = columns_.sorted(samples.planes[t.plane]);
    auto source = std::find(sources_.begin(), sources_.end(), plane);
    source_of_.push_back(static_cast<size_t>(source - sources_.begin()));
    if (source == sources_.end()) sources_.push_back(plane);
  }
  while (sources_.size() % WindowWeights::kPlanes != 0)
    sources_.push_back(sources_[0]);
  at_.resize(sources_.size());
  means_.resize(sources_.size() * SampleColumns::kBlock);
  const FilterWindow& window = plan.weights.window();
  offsets_.clear();
  for (int j = window.j0; j < window.j1; ++j)
    for (int i = window.i0; i < window.i1; ++i)
      offsets_.push_back(columns_.offset(i, j));
  for_runs(samples.rect, [&](const Run& run) {
    // Rows and columns of samples that the filters of the run reach. Beyond a narrow margin there are none.
    const int row = (run.y - samples.covered.y0) * size_.ysamples + window.j0;
    const int column = (run.x0 - samples.covered.x0) * size_.xsamples + window.i0;
    const int columns = (run.x1 - run.x0 - 1) * size_.xsamples + window.i1 - window.i0;
    const SampleSpan any =
        filled(samples, static_cast<size_t>(row), static_cast<size_t>(row) + window.rows());
    if (any.overlaps(static_cast<size_t>(column), static_cast<size_t>(column + columns))) {
      const std::ptrdiff_t place = columns_.place(run.block(), run.y);
      for (size_t s = 0; s < at_.size(); ++s)
        at_[s] = sources_[s] + place;
      WindowWeights::means(at_, offsets_, plan.weights.at(run.block(), run.y, samples.pattern),
                           means_.data());
    } else {
      std::fill(means_.begin(), means_.end(), 0.0f);
    }
    for (size_t t = 0; t < plan.terms.size(); ++t)
      set(image, run, plan.terms[t].channel, means_.data() + source_of_[t] * SampleColumns::kBlock);
  });
}

void Reconstructor::set_depths(const BucketSamples& samples, Image& image) {
  if (depths_.empty()) return;
  offsets_.clear();
  for (int j = 0; j < size_.ysamples; ++j)
    for (int i = 0; i < size_.xsamples; ++i)
      offsets_.push_back(columns_.offset(i, j));
  const float* z = columns_.sorted(samples.planes[Image::kZ]);
  float depths[SampleColumns::kBlock];
  for_runs(samples.rect, [&](const Run& run) {
    find_depths(z + columns_.place(run.block(), run.y), depths);
    for (size_t channel : depths_)
      set(image, run, channel, depths);
  });
}

/// Of a block, from the pixels' own samples, at `z` and the offsets: those without a surface do not count
/// unless all are so. Loops over lanes are the inner ones, for the compiler to use vectors.
void Reconstructor::find_depths(const float* z, float* out) const {
  constexpr size_t kBlock = SampleColumns::kBlock;
  const bool most = settings_.depth_filter == DepthFilter::kMax,
             mean = settings_.depth_filter == DepthFilter::kAverage;
  std::fill_n(out, kBlock, kInfinity);
  for (std::ptrdiff_t offset : offsets_)
    for (size_t k = 0; k < kBlock; ++k)
      out[k] = std::min(out[k], z[offset + static_cast<std::ptrdiff_t>(k)]);
  for (size_t k = 0; (most || mean) && k < kBlock; ++k) {
    double sum = 0;
    int count = 0;
    for (std::ptrdiff_t offset : offsets_) {
      const float at = z[offset + static_cast<std::ptrdiff_t>(k)];
      if (at == kInfinity) continue;
      if (most) out[k] = std::max(out[k], at);
      sum += static_cast<double>(at);
      ++count;
    }
    if (mean && count > 0) out[k] = static_cast<float>(sum / count);
  }
  for (size_t k = 0; k < kBlock; ++k)
    out[k] = out[k] == kInfinity ? Image::kEmptyDepth : out[k];
}

void Reconstructor::copy_samples(const BucketSamples& samples, Image& image) const {
  const PixelRect& rect = samples.rect;
  const auto width = static_cast<size_t>(samples.pattern.width()),
             count = static_cast<size_t>(rect.width() * size_.xsamples);
  const auto first = static_cast<size_t>((rect.x0 - samples.covered.x0) * size_.xsamples);
  for (int y = rect.y0 * size_.ysamples; y < rect.y1 * size_.ysamples; ++y) {
    const size_t k = static_cast<size_t>(y - samples.covered.y0 * size_.ysamples) * width + first;
    auto to = [&](size_t channel) {
      return image.row(static_cast<int>(channel), rect.x0 * size_.xsamples, y);
    };
    for (const Plan& plan : plans_)
      for (const Term& t : plan.terms)
        std::copy_n(samples.planes[t.plane] + k, count, to(t.channel));
    for (size_t channel : depths_)
      std::transform(samples.planes[Image::kZ] + k, samples.planes[Image::kZ] + k + count, to(channel),
                     [](float z) { return std::min(z, Image::kEmptyDepth); });
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

std::vector<size_t> ReconstructionSettings::depth_channels() const {
  std::vector<size_t> out;
  if (shown[Image::kZ]) out.push_back(Image::kZ);
  for (const AovChannel& a : aovs)
    if (a.source == AovChannel::Source::kDepth) out.push_back(static_cast<size_t>(Image::kAov + a.first));
  return out;
}

void clear(const ReconstructionSettings& settings, PixelRect rect, Image& image) {
  for (size_t channel : settings.depth_channels())
    for (int y = rect.y0; y < rect.y1; ++y)
      std::fill_n(image.row(static_cast<int>(channel), rect.x0, y), rect.width(), Image::kEmptyDepth);
}

} // namespace render
