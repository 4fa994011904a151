// Means of textures over regions.
#pragma once

#include "render/texture/texture_image.h"
#include "slvm/textures.h"

namespace render {

/// A region of a texture: its middle, and how s and t change along its two sides; (0, 0) is the upper left
/// corner of the image, (1, 1) the lower right one. The parts of the image by which the region is blurred are
/// apart.
struct TextureRegion {
  float s, t, s_u, t_u, s_v, t_v;
  float sblur = 0, tblur = 0;
};

/// Takes the same kind of mean of one texture again and again.
///
/// The sides and the blur, as the spread they have together (a covariance), are an ellipse with a long and a
/// short axis. The short one decides the level; along the long one several places are looked at, by
/// interpolation in the two nearest levels. Level and places are such that what is looked at has the spread
/// of the region. (The Feline of McCormack, Perry, Farkas and Jouppi, 1999, on the ellipses of Heckbert,
/// 1989.)
class TextureFilter {
public:
  /// For `channels` channels from `options` and the lookup.
  TextureFilter(const TextureImage& image, const slvm::TextureLookup& lookup, TextureWrap swrap,
                TextureWrap twrap);
  /// False: texels cannot be read (image.problem()).
  bool mean(const TextureRegion& region, float* out) const;

private:
  enum class Interpolation : uint8_t { kNearest, kBilinear, kBSpline, kCatmullRom };
  struct Ellipse {
    float s = 0, t = 0;              ///< half of the long axis, in parts of the image
    float longest = 0, shortest = 0; ///< the axes, in texels
  };
  Ellipse ellipse_of(const TextureRegion& region) const;
  bool add_level(const TextureRegion& region, const Ellipse& ellipse, size_t level, float weight,
                 Interpolation way, float* out, float& counted) const;
  template <class T>
  void add_texels(const TextureImage::Level& level, Interpolation way, float s, float t, float weight,
                  float* out, float& counted) const;

  const TextureImage& image_;
  TextureWrap wrap_[2];
  float width_, height_, most_places_, fill_, ignore_above_;
  bool between_levels_, one_sample_, gaussian_, triangle_;
  Interpolation interpolation_;
  size_t first_, present_, channels_; ///< present: of the channels, those that the image has
};

} // namespace render
