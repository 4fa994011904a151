// Smaller images of an image: the levels of mip-maps.
#pragma once

#include "render/texture/filter_kind.h"
#include "render/texture/pixels.h"
#include "render/texture/wrap.h"

#include <functional>

namespace render {

struct ImageSize {
  int width = 0, height = 0;
  bool operator==(const ImageSize&) const = default;
};
/// Of the level after one of this size.
ImageSize half_of(ImageSize size);

/// How a level is made of the one before.
struct LevelFilter {
  FilterKind kind = FilterKind::kBox; ///< box and disk: means over the areas of the smaller image's pixels
  /// Black sides count as clamp: they would make the whole border darker.
  TextureWrap swrap = TextureWrap::kClamp, twrap = TextureWrap::kClamp;
  bool sphere = false; ///< rows are latitudes: they count by how long they are there
};

/// The row: in `scratch` or wherever it is.
using ReadRow = std::function<const float*(int y, float* scratch)>;
using WriteRow = std::function<void(int y, const float* row)>;
void shrink(ImageSize from, const ReadRow& read, ImageSize to, const WriteRow& write, size_t channels,
            const LevelFilter& filter);

/// sum += weight * from: a row's part in a mean of rows.
void add_scaled(const float* from, float weight, size_t count, float* sum);

FloatImage half_of(const FloatImage& image, const LevelFilter& filter);

} // namespace render
