// The samples of one bucket, and the micropolygons drawn into them: what each sample sees is kept in layers
// (sample_layers.h), composited when all grids are in, and then filtered into pixels (reconstruct.h).
#pragma once

#include "render/hider/depth_mask.h"
#include "render/hider/image.h"
#include "render/hider/moving_reach.h"
#include "render/hider/quad_hits.h"
#include "render/hider/quad_paint.h"
#include "render/hider/sample_layers.h"
#include "render/hider/sample_pattern.h"
#include "render/hider/shaded_grid.h"
#include "render/hider/solid_hits.h"
#include "render/hider/strata_samples.h"
#include "render/state/options.h"

#include <cstdint>
#include <vector>

namespace render {

struct SamplingSettings {
  SampleGridSize size;
  ReconstructionSettings reconstruction;
  Color opacity_threshold = LayerSettings().opacity_threshold;
  Color depth_threshold = LayerSettings().depth_threshold;
  float near_plane = 0, far_plane = kInfinity;
  bool moving = false;            ///< grids may move
  const Camera* lens = nullptr;   ///< null: all is in focus
  const Camera* camera = nullptr; ///< for clipping_planes
  std::vector<ClippingPlane> clipping_planes;
  const DepthMask* mask = nullptr;
  Vec2 mask_scale{1.0f};                  ///< from raster to parts of the frame
  std::shared_ptr<const JitterTile> tile; ///< null: each buffer makes its own

  static SamplingSettings from(const Options&, const std::vector<AovChannel>&);
  size_t aov_floats() const { return reconstruction.aov_floats(); }
  LayerSettings layers() const {
    return {opacity_threshold, depth_threshold, reconstruction.depth_filter == DepthFilter::kMidpoint,
            aov_floats()};
  }
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
  /// Whether nothing beyond camera z can be seen any more; never while a sample is open.
  bool hides(float z) const { return layers_.hides(z); }
  /// Whether nothing beyond z can be seen in a rectangle of the raster, as far as the samples cover it.
  bool hides(Vec2 low, Vec2 high, float z) const;
  /// Composites and filters into the image's pixels of the bucket. Call once for each bucket, after the last
  /// draw.
  void finish(Image& image);

private:
  /// Whether all that opaque micropolygons of the grid change are depths and values of samples.
  bool can_paint(const ShadedGrid& grid) const;
  void paint_grid(const ShadedGrid& grid);
  void draw_micropolygon(const ShadedGrid& grid, size_t k);
  void draw_moving(const ShadedGrid& grid, size_t k, const Box& reach);
  void draw_slow(const ShadedGrid& grid, size_t k, const Box& reach);
  void draw_segment(const ShadedGrid& grid, size_t k, MovingQuad& quad, int stratum);
  void draw_in_box(const ShadedGrid& grid, size_t k, const Box& box, MovingQuad& quad, int stratum);
  /// What the lens does to things between two depths: `shift`, of what has a defocus of 1, times these.
  struct Defocus {
    float near, far;
  };
  Defocus defocus(const Box& box) const;
  static void add_lens(const Box& shift, const Defocus& by, Box& box);
  SampleField field(const ShadedGrid& grid) const;
  StratumField field(const ShadedGrid& grid, int stratum);
  /// Of a micropolygon: three corners, the first of which is its own, and their weights.
  struct Spot {
    size_t corners[3];
    float weights[3];
  };
  void make_room(const SampleWindow& window);
  void hit_all(const ShadedGrid& grid, size_t k, size_t count);
  void hit_flat(const ShadedGrid& grid, size_t k, std::span<const QuadHit> hits);
  SampleSurface surface_at(const ShadedGrid& grid, const Spot& spot);
  void hit_solid(const ShadedGrid& grid, const SampleSurface& surface, const Spot& spot, const QuadHit& hit);
  void add(size_t index, float z, const SampleSurface& surface);
  bool takes(const ShadedGrid& grid, const QuadHit& hit) const;
  void resolve_solid();
  /// Left out by a clipping plane or by the depth mask.
  bool removed(size_t index, float z) const;

  SamplingSettings settings_;
  PixelRect rect_, covered_;
  Vec2 origin_{0.0f}; ///< of covered_
  SamplePattern pattern_;
  Reconstructor reconstructor_;
  Vec2 density_; ///< samples a pixel
  SampleLayers layers_;
  std::vector<QuadHit> hits_;
  std::vector<size_t> not_painted_; ///< micropolygons of a grid
  /// Each sample's point of the lens, as raster shift of what has a defocus of 1.
  std::vector<float> lens_x_, lens_y_;
  MovingReach reach_;
  StrataSamples strata_;
  bool strata_known_ = false;              ///< of this bucket
  std::vector<Box> lens_boxes_;            ///< the same, of each stratum
  Box lens_box_;                           ///< and of all of them
  size_t aovs_;                            ///< floats of variables for each sample
  std::shared_ptr<const SolidTree> solid_; ///< whose grids are being drawn
  SolidHits solid_hits_;
  std::vector<float> solid_aov_, blended_aov_;
};

} // namespace render
