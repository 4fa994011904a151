// Where, when and through which point of the lens the samples of an area are taken. All of it depends on the
// sample's place in the frame only, never on buckets or crop windows. Positions come from a tile that repeats
// itself, so that the weights filters give them do, too.
#pragma once

#include "render/hider/quad_hits.h"
#include "render/state/camera.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace render {

struct SampleGridSize {
  int xsamples = 2, ysamples = 2; ///< per pixel
  bool jitter = true;
  bool levels = false; ///< samples have numbers for levels of detail
};

/// Where in their cells, [0, 1), the samples of a square of pixels lie, which repeats itself in the frame.
struct JitterTile {
  int period = 1;          ///< pixels a side: a power of two
  std::vector<float> x, y; ///< in rows

  explicit JitterTile(const SampleGridSize& size);
};

/// The n samples of a pixel share the shutter time and the lens: each stratum, 1/n of the time and 1/n of the
/// lens, has exactly one sample of every pixel.
class SamplePattern {
public:
  static constexpr size_t kPadding = SampleField::kPadding;

  /// `timed`: with times. `lens`: with lens points, too. `tile`: that of another pattern of this size; null:
  /// it makes its own.
  SamplePattern(const SampleGridSize& size, bool timed, bool lens,
                std::shared_ptr<const JitterTile> tile = nullptr);
  const std::shared_ptr<const JitterTile>& tile() const { return tile_; }
  /// From now on for this area.
  void cover(PixelRect area);

  /// The jitter of positions repeats itself every so many pixels in x and y: a power of two.
  int period() const { return tile_->period; }
  /// Where in their cells, [0, 1), samples of pixels beside each other lie: the first is in that column and
  /// row of the frame, the others follow at distances of a pixel.
  void jitter(std::span<float> x, std::span<float> y, int column, int row) const;

  /// Whether any sample of the frame lies in a rectangle of the raster, give or take rounding. Of one that is
  /// not small, or far from all pictures, it is taken for granted.
  bool may_have(Vec2 low, Vec2 high) const;

  int width() const { return width_; } ///< samples in a row
  int height() const { return height_; }
  int columns() const { return columns_; } ///< pixels in a row
  size_t count() const { return count_; }
  Vec2 at(size_t k) const { return {x_[k], y_[k]}; } ///< raster
  const float* x() const { return x_.data(); }       ///< kPadding longer than count()
  const float* y() const { return y_.data(); }
  float time(size_t k) const { return time_[k]; }     ///< part of the shutter time, [0, 1)
  const float* times() const { return time_.data(); } ///< kPadding longer
  Vec2 lens(size_t k) const { return lens_[k]; }      ///< in the unit disk
  float level(size_t k) const { return level_[k]; } ///< [0, 1); each nth of it has one sample of every pixel

  int strata() const { return strata_; }
  /// The samples in a stratum, one of each pixel, pixels in rows; kPadding longer.
  const uint32_t* of_stratum(int stratum) const {
    return of_stratum_.data() + static_cast<size_t>(stratum) * pixels();
  }
  /// The box around a stratum's part of the lens.
  struct LensBox {
    Vec2 min, max;
  };
  const LensBox& lens_box(int stratum) const { return lens_boxes_[static_cast<size_t>(stratum)]; }

private:
  size_t pixels() const { return count_ / static_cast<size_t>(strata_); }
  void make_lens_boxes();
  Vec2 lens_corner(size_t stratum) const;
  void add_strata(PixelRect area);
  void add_levels(PixelRect area);

  SampleGridSize size_;
  bool timed_, with_lens_;
  std::shared_ptr<const JitterTile> tile_;
  int width_ = 0, height_ = 0, columns_ = 0, strata_;
  size_t count_ = 0;
  std::vector<float> x_, y_;
  std::vector<Vec2> lens_;
  std::vector<float> time_, level_;
  std::vector<uint32_t> of_stratum_;
  std::vector<int> lens_cells_; ///< of each stratum: the same in the whole frame, in no order
  std::vector<LensBox> lens_boxes_;
};

} // namespace render
