// The samples of one bucket: the opaque surface nearest to each, and the transparent ones in front of it;
// composited when all grids are in, and then filtered into pixels (reconstruct.h).
#pragma once

#include "render/hider/depth_mask.h"
#include "render/hider/image.h"
#include "render/hider/quad_hits.h"
#include "render/hider/quad_paint.h"
#include "render/hider/reconstruct.h"
#include "render/hider/sample_pattern.h"
#include "render/hider/shaded_grid.h"
#include "render/hider/solid_hits.h"
#include "render/state/options.h"

#include <cstdint>
#include <vector>

namespace render {

struct SamplingSettings {
  SampleGridSize size;
  ReconstructionSettings reconstruction;
  Color opacity_threshold{0.996f};
  Color depth_threshold{1.0f}; ///< a transparent surface as opaque as this has a depth
  float near_plane = 0, far_plane = kInfinity;
  bool moving = false;            ///< grids may move
  const Camera* lens = nullptr;   ///< null: all is in focus
  const Camera* camera = nullptr; ///< for clipping_planes
  std::vector<ClippingPlane> clipping_planes;
  const DepthMask* mask = nullptr;
  Vec2 mask_scale{1.0f}; ///< from raster to parts of the frame

  static SamplingSettings from(const Options&, const std::vector<AovChannel>&);
  size_t aov_floats() const { return reconstruction.aov_floats(); }
};

/// Serves one bucket after another.
class SampleBuffer {
public:
  explicit SampleBuffer(const SamplingSettings& settings);
  /// Forgets everything and goes on with the pixels of `rect`.
  void begin(PixelRect rect);

  /// The area the samples lie in, margins included; x1 and y1 excluded.
  PixelRect covered() const { return covered_; }
  /// The grids of a solid come one after another, all of them, whether they can be seen or not.
  void draw(const ShadedGrid& grid);
  /// Camera z beyond which nothing can be seen any more; infinite while a sample is open.
  float farthest() const;
  /// Composites and filters into the image's pixels of the bucket. Call once for each bucket, after the last
  /// draw.
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
  static constexpr uint32_t kNone = 0xffffffffu;

  /// Whether all that opaque micropolygons of the grid change are depths and values of samples.
  bool can_paint(const ShadedGrid& grid) const;
  void paint_grid(const ShadedGrid& grid);
  /// From now on samples may have surfaces that are not plainly opaque.
  void make_layers();
  void draw_micropolygon(const ShadedGrid& grid, size_t k);
  void draw_moving(const ShadedGrid& grid, size_t k);
  void draw_slow(const ShadedGrid& grid, size_t k);
  void draw_segment(const ShadedGrid& grid, size_t k, MovingQuad& quad, int stratum);
  void add_lens(const Box& shift, Box& box) const;
  SampleField field(const ShadedGrid& grid) const;
  void make_room(const SampleWindow& window);
  void hit_all(const ShadedGrid& grid, size_t k, size_t count);
  void hit(const ShadedGrid& grid, size_t index, const size_t (&corners)[3], const float (&weights)[3],
           float z);
  const float* variables_of(const ShadedGrid& grid, const size_t (&corners)[3], const float (&weights)[3]);
  void hit_solid(const ShadedGrid& grid, size_t index, const size_t (&corners)[3], const float (&weights)[3],
                 float z);
  /// The depths from which on a surface would not change the samples.
  std::vector<float>& limits() { return midpoint_ ? second_ : depths(); }
  const std::vector<float>& limits() const { return midpoint_ ? second_ : depths(); }
  /// Of each sample's nearest opaque surface; infinite: none. In the end that of all surfaces.
  std::vector<float>& depths() { return planes_[Image::kZ]; }
  const std::vector<float>& depths() const { return planes_[Image::kZ]; }
  Color colour(size_t index, int channel) const;
  void set_colour(size_t index, int channel, const Color& c);
  void set_aov(size_t index, const float* values);
  /// A surface over a sample, in front of what is opaque there.
  void add(size_t index, const Color& Ci, const Color& Oi, float z, bool matte, const float* aov);
  void resolve_solid();
  /// Left out by a clipping plane or by the depth mask.
  bool removed(size_t index, float z) const;
  void find_filled();
  void composite_all();
  void composite(size_t index);
  float opaque_depth(size_t index) const;
  std::vector<const float*> planes() const;

  SamplingSettings settings_;
  PixelRect rect_, covered_;
  Vec2 origin_{0.0f}; ///< of covered_
  SamplePattern pattern_;
  Reconstructor reconstructor_;
  Vec2 density_; ///< samples a pixel
  /// A plane of samples for each channel of an image: of the nearest opaque surface, in the end of all.
  std::vector<std::vector<float>> planes_;
  /// No sample has layers: its opacities are all 1 where it has a surface, and not in the planes.
  bool plain_ = true;
  std::vector<float> matte_;           ///< 1: the opaque surface is
  std::vector<uint32_t> fragments_of_; ///< in front of what is opaque: the first, or kNone
  std::vector<float> second_;          ///< depth of the opaque surface behind it; for midpoints only
  std::vector<QuadHit> hits_;
  std::vector<size_t> not_painted_; ///< micropolygons of a grid
  std::vector<SampleSpan> filled_;  ///< of each row, what holds all samples with something
  std::vector<Vec2> lens_;          ///< each sample's point of the lens, as raster shift without defocus
  std::vector<Box> lens_boxes_;     ///< the same, of each stratum
  Box lens_box_;                    ///< and of all of them
  std::vector<Fragment> fragments_;
  size_t aovs_; ///< floats of variables for each sample
  std::vector<float> fragment_aov_;
  std::vector<const Fragment*> scratch_;
  std::shared_ptr<const SolidTree> solid_; ///< whose grids are being drawn
  SolidHits solid_hits_;
  std::vector<float> solid_aov_, blended_aov_;
  size_t open_ = 0; ///< samples that a surface at any depth would change
  bool midpoint_;
  mutable float farthest_ = kInfinity;
  mutable bool farthest_known_ = false;
};

} // namespace render
