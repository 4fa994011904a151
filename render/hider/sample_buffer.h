// The samples of one bucket: jittered positions, the opaque surface nearest to each, and the transparent ones
// in front of it; composited and filtered into pixels when all grids are in.
#pragma once

#include "render/hider/image.h"
#include "render/hider/shaded_grid.h"
#include "render/state/options.h"

#include <cstdint>
#include <vector>

namespace render {

struct SamplingSettings {
  int xsamples = 2, ysamples = 2; ///< per pixel
  bool jitter = true;
  PixelFilter filter;
  Color opacity_threshold{0.996f};
  float near_plane = 0, far_plane = kInfinity;
  int aov_floats = 0;

  static SamplingSettings from(const Options&, int aov_floats);
  /// Pixels around a bucket whose samples its filter reaches.
  int xmargin() const;
  int ymargin() const;
};

class SampleBuffer {
public:
  /// For the pixels of `rect`.
  SampleBuffer(PixelRect rect, const SamplingSettings& settings);

  /// The area the samples lie in, margins included; x1 and y1 excluded.
  PixelRect covered() const { return covered_; }
  void draw(const ShadedGrid& grid);
  /// Camera z beyond which nothing can be seen any more; infinite while a sample is open.
  float farthest() const;
  /// Composites and filters into the image's pixels of the bucket. Call once, after the last draw.
  void finish(Image& image);

private:
  /// A transparent surface over a sample.
  struct Fragment {
    Color Ci, Oi;
    float z;
    uint32_t next;  ///< further fragments of the sample; kNone at the end
    uint32_t order; ///< of arrival, to decide between equal depths
    bool matte;
  };
  struct Sample {
    Vec2 at;
    float z = kInfinity; ///< of the nearest opaque surface; infinite: none
    Color Ci{0.0f}, Oi{0.0f};
    uint32_t fragments = kNone;
    bool matte = false;
  };
  /// What a sample comes to: Ci, Oi and the depth of the first surface.
  struct Result {
    Color Ci{0.0f}, Oi{0.0f};
    float z = kInfinity;
  };
  static constexpr uint32_t kNone = 0xffffffffu;

  void draw_micropolygon(const ShadedGrid& grid, size_t k);
  void hit(const ShadedGrid& grid, Sample& sample, size_t index, const size_t (&corners)[3],
           const float (&weights)[3]);
  Result composite(size_t index);
  void filter_pixel(int x, int y, float* out) const;

  SamplingSettings settings_;
  PixelRect rect_, covered_;
  int width_, height_; ///< samples
  std::vector<Sample> samples_;
  std::vector<Fragment> fragments_;
  std::vector<float> sample_aov_, fragment_aov_;
  std::vector<Result> results_;
  std::vector<const Fragment*> scratch_;
  size_t open_;
  mutable float farthest_ = kInfinity;
  mutable bool farthest_known_ = false;
};

} // namespace render
