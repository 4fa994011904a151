#include "render/hider/after_filter.h"

#include "render/hider/random.h"

#include <algorithm>

namespace render {

AfterFilter::AfterFilter(const Options& options, std::span<const AovChannel> aovs)
    : options_(options), aovs_(aovs), pictures_(find_pictures()) {}

void AfterFilter::run(const PixelRect& rect, Image& image, GridShader& shader, slvm::Grid& scratch) const {
  expose_all(rect, image);
  if (!options_.imager) return;
  for (const Picture& p : pictures_)
    run_imager(rect, p, image, shader, scratch);
}

void AfterFilter::expose_all(const PixelRect& rect, Image& image) const {
  expose(rect, Image::kCi, 3, {options_.gain, options_.gamma}, image);
  using Source = AovChannel::Source;
  for (const AovChannel& a : aovs_)
    if (a.source == Source::kColor || a.source == Source::kVariable)
      expose(rect, Image::kAov + a.first, a.components, a.exposure, image);
}

void AfterFilter::expose(const PixelRect& rect, int first, int count, const std::array<float, 2>& exposure,
                         Image& image) {
  auto [gain, gamma] = exposure;
  if (gain == 1 && gamma == 1) return;
  for (int c = first; c < first + count; ++c)
    for (int y = rect.y0; image.has(c) && y < rect.y1; ++y) {
      float* row = image.row(c, rect.x0, y);
      for (int x = 0; x < rect.width(); ++x)
        row[x] = exposed(row[x], gain, gamma);
    }
}

/// The standard one, and those with a filter or an exposure of their own (channels.h sees to it that they are
/// complete).
std::vector<AfterFilter::Picture> AfterFilter::find_pictures() const {
  std::vector<Picture> out{{Image::kCi, Image::kOi, Image::kAlpha}};
  using Source = AovChannel::Source;
  auto place = [&](const AovChannel& of, Source source) {
    for (const AovChannel& a : aovs_)
      if (a.source == source && a.exposure == of.exposure && a.filter == of.filter)
        return Image::kAov + a.first;
    return -1;
  };
  for (const AovChannel& a : aovs_)
    if (a.source == Source::kColor)
      out.push_back({Image::kAov + a.first, place(a, Source::kOpacity), place(a, Source::kAlpha)});
  std::erase_if(out, [](const Picture& p) { return p.Oi < 0 || p.alpha < 0; });
  return out;
}

void AfterFilter::run_imager(const PixelRect& rect, const Picture& picture, Image& image, GridShader& shader,
                             slvm::Grid& grid) const {
  grid.reset(rect.width(), rect.height());
  grid.derivatives = true;
  grid.flip_normals = false;
  grid.object_to_current = {};
  grid.id = hash_of(rect.x0, rect.y0, kImager);
  grid.user = nullptr;
  using slvm::Global;
  float *P = grid.varying(Global::kP), *s = grid.varying(Global::ks), *t = grid.varying(Global::kt);
  float *Ci = grid.varying(Global::kCi), *Oi = grid.varying(Global::kOi),
        *alpha = grid.varying(Global::kalpha);
  const auto width = static_cast<size_t>(rect.width()), pitch = grid.pitch();
  for (int y = rect.y0; y < rect.y1; ++y) {
    const size_t row = static_cast<size_t>(y - rect.y0) * width;
    for (size_t k = 0; k < width; ++k) {
      P[row + k] = static_cast<float>(rect.x0) + static_cast<float>(k) + 0.5f;
      P[pitch + row + k] = static_cast<float>(y) + 0.5f;
      P[2 * pitch + row + k] = 0;
      s[row + k] = P[row + k] / static_cast<float>(options_.xres);
      t[row + k] = P[pitch + row + k] / static_cast<float>(options_.yres);
    }
    auto take = [&](int channel, float* to) { std::copy_n(image.row(channel, rect.x0, y), width, to + row); };
    for (size_t c = 0; c < 3; ++c) {
      take(picture.Ci + static_cast<int>(c), Ci + c * pitch);
      take(picture.Oi + static_cast<int>(c), Oi + c * pitch);
    }
    take(picture.alpha, alpha);
  }
  shader.image(*options_.imager, grid);
  auto give = [&](Global g, size_t component, int channel) {
    const slvm::Planes& from = grid.variable(g);
    for (int y = rect.y0; y < rect.y1; ++y) {
      const size_t row = static_cast<size_t>(y - rect.y0) * width;
      float* to = image.row(channel, rect.x0, y);
      for (size_t k = 0; k < width; ++k)
        to[k] = from.get(component, row + k);
    }
  };
  for (size_t c = 0; c < 3; ++c) {
    give(Global::kCi, c, picture.Ci + static_cast<int>(c));
    give(Global::kOi, c, picture.Oi + static_cast<int>(c));
  }
  give(Global::kalpha, 0, picture.alpha);
}

} // namespace render
