// Means of textures over regions.
#pragma once

#include "render/texture/lookup_block.h"
#include "render/texture/texture_image.h"
#include "slvm/textures.h"

#include <algorithm>
#include <vector>

namespace render {

/// Regions of a texture: their middles, and how s and t change along their two sides; (0, 0) is the upper
/// left corner of the image, (1, 1) the lower right one. The parts of the image by which they are blurred are
/// apart. Many at a time, by component.
struct TextureRegions {
  static constexpr size_t kBlock = kLookupBlock;
  using Lanes = LookupLanes;

  alignas(64) Lanes s = {}, t = {}, s_u = {}, t_u = {}, s_v = {}, t_v = {}, sblur = {}, tblur = {};
  alignas(64) Lanes stretch = {}; ///< of all regions at this place, along s; 0: there is none
};

/// How texels of a level are put together at a place.
enum class Interpolation : uint8_t { kNearest, kBilinear, kBSpline, kCatmullRom };

/// Where to look for the mean over a region: at places along a line, in two levels (or one, with weight 1).
struct TexturePlaces {
  using Lanes = TextureRegions::Lanes;

  alignas(64) Lanes s, t; ///< half of the line, in parts of the image, if it has the whole spread
  struct {
    alignas(64) Lanes weight, places, scale; ///< scale: of the line
    alignas(64) int32_t level[TextureRegions::kBlock];
  } in[2];
  alignas(64) Lanes longest; ///< of the region, in texels
};

/// Places in one level, and whose they are.
struct TextureProbes {
  std::vector<float> s, t, weight;
  std::vector<uint32_t> sum; ///< which of the sums they are added to
  size_t count = 0;          ///< of those in use

  /// Room for more, in whole blocks; the first one of them. What is not used yet is added to a sum nobody
  /// wants.
  size_t add(size_t more) {
    constexpr size_t kBlock = TextureRegions::kBlock;
    const size_t first = count, size = ((count += more) + kBlock - 1) / kBlock * kBlock;
    if (size > s.size()) {
      for (auto* numbers : {&s, &t, &weight})
        numbers->resize(size);
      sum.resize(size, 2 * kBlock);
    }
    return first;
  }
  void clear() {
    std::fill_n(sum.begin(), count, 2 * TextureRegions::kBlock);
    count = 0;
  }
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
  static constexpr size_t kBlock = TextureRegions::kBlock;
  using Means = float[slvm::TextureLookup::kMost][kBlock];

  /// For `channels` channels from `options` and the lookup.
  TextureFilter(const TextureImage& image, const slvm::TextureLookup& lookup, TextureWrap swrap,
                TextureWrap twrap);
  /// Of the regions whose bits are set in `active`; 0 where s or t is no finite number. False: texels cannot
  /// be read (image.problem()).
  bool means(const TextureRegions& regions, uint32_t active, Means& out);

  // What the loops for each instruction set need.
  struct Layout {
    size_t texel = 0, first = 0,
           channels = 0; ///< bytes: of a texel, before the first channel; channels there are
    PixelType type = PixelType::kByte;
    TextureWrap wrap[2] = {};
    bool limited = false;
    float ignore_above = 0; ///< texels with a channel greater than this do not count; where `limited`
  };
  /// What is summed up for a region: three channels, and the weight of the texels that count if `limited`.
  static constexpr size_t kSums = 4;
  struct Limits {
    float width, height, most_places, most_stretched, last_level;
    bool between_levels;
  };

private:
  void add_probes(const TextureRegions& regions, const TexturePlaces& places, uint32_t lane);
  float shape(float x) const;

  const TextureImage& image_;
  Layout layout_;
  Limits limits_;
  size_t channels_;
  float fill_, one_; ///< one: the texel that means 1
  bool one_sample_, gaussian_, triangle_;
  Interpolation interpolation_;
  std::vector<TextureProbes> probes_; ///< of each level; the last: of the first level, without interpolation
};

} // namespace render
