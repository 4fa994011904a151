#include "render/hider/after_filter.h"

#include "render/hider/random.h"

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
  float* planes[6] = {grid.varying(Global::kP),     grid.varying(Global::kCi), grid.varying(Global::kOi),
                      grid.varying(Global::kalpha), grid.varying(Global::ks),  grid.varying(Global::kt)};
  size_t pitch = grid.pitch(), k = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x, ++k) {
      planes[0][k] = static_cast<float>(x) + 0.5f;
      planes[0][pitch + k] = static_cast<float>(y) + 0.5f;
      planes[0][2 * pitch + k] = 0;
      for (int c = 0; c < 3; ++c) {
        planes[1][static_cast<size_t>(c) * pitch + k] = image.at(picture.Ci + c, x, y);
        planes[2][static_cast<size_t>(c) * pitch + k] = image.at(picture.Oi + c, x, y);
      }
      planes[3][k] = image.at(picture.alpha, x, y);
      planes[4][k] = planes[0][k] / static_cast<float>(options_.xres);
      planes[5][k] = planes[0][pitch + k] / static_cast<float>(options_.yres);
    }
  shader.image(*options_.imager, grid);
  const slvm::Planes &Ci = grid.variable(Global::kCi), &Oi = grid.variable(Global::kOi),
                     &alpha = grid.variable(Global::kalpha);
  k = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x, ++k) {
      for (int c = 0; c < 3; ++c) {
        *image.row(picture.Ci + c, x, y) = Ci.get(static_cast<size_t>(c), k);
        *image.row(picture.Oi + c, x, y) = Oi.get(static_cast<size_t>(c), k);
      }
      *image.row(picture.alpha, x, y) = alpha.get(0, k);
    }
}

} // namespace render
