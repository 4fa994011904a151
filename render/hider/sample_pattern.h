// Where, when and through which point of the lens the samples of an area are taken. All of it depends on the
// sample's place in the frame only, never on buckets or crop windows.
#pragma once

#include "render/state/camera.h"

#include <cstdint>
#include <vector>

namespace render {

struct SampleGridSize {
  int xsamples = 2, ysamples = 2; ///< per pixel
  bool jitter = true;
  bool levels = false; ///< samples have numbers for levels of detail
};

/// The n samples of a pixel share the shutter time and the lens: each stratum, 1/n of the time and 1/n of the
/// lens, has exactly one sample of every pixel.
class SamplePattern {
public:
  /// `timed`: also times and lens points.
  SamplePattern(PixelRect area, const SampleGridSize& size, bool timed);

  int width() const { return width_; } ///< samples in a row
  int height() const { return height_; }
  size_t count() const { return at_.size(); }
  Vec2 at(size_t k) const { return at_[k]; }        ///< raster
  float time(size_t k) const { return time_[k]; }   ///< part of the shutter time, [0, 1)
  Vec2 lens(size_t k) const { return lens_[k]; }    ///< in the unit disk
  float level(size_t k) const { return level_[k]; } ///< [0, 1); each nth of it has one sample of every pixel

  int strata() const { return strata_; }
  /// The sample of a pixel (counted in the area) that is in a stratum.
  uint32_t of_stratum(int column, int row, int stratum) const {
    return of_stratum_[(static_cast<size_t>(row) * static_cast<size_t>(columns_) +
                        static_cast<size_t>(column)) *
                           static_cast<size_t>(strata_) +
                       static_cast<size_t>(stratum)];
  }
  /// The box around a stratum's part of the lens.
  struct LensBox {
    Vec2 min, max;
  };
  const LensBox& lens_box(int stratum) const { return lens_boxes_[static_cast<size_t>(stratum)]; }

private:
  void add_strata(PixelRect area, const SampleGridSize& size);
  void add_levels(PixelRect area, const SampleGridSize& size);

  int width_, height_, columns_, strata_;
  std::vector<Vec2> at_, lens_;
  std::vector<float> time_, level_;
  std::vector<uint32_t> of_stratum_;
  std::vector<LensBox> lens_boxes_;
};

} // namespace render
