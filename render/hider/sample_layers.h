// What the samples of one bucket see: the nearest opaque surface of each, and the transparent ones in front
// of it, composited when all are in.
#pragma once

#include "render/hider/image.h"
#include "render/hider/reconstruct.h"
#include "render/hider/sample_window.h"

#include <cstdint>
#include <span>
#include <vector>

namespace render {

struct LayerSettings {
  Color opacity_threshold{0.996f}; ///< a surface as opaque as this hides what is behind it
  Color depth_threshold{1.0f};     ///< a transparent surface as opaque as this has a depth
  bool midpoint = false;           ///< depths are half way to the opaque surface behind the nearest
  size_t aovs = 0;                 ///< floats of variables
};

/// What a surface looks like at a sample.
struct SampleSurface {
  Color Ci, Oi;
  bool matte = false;
  const float* aov = nullptr; ///< its variables

  bool is_nothing() const { return Ci == Color(0.0f) && Oi == Color(0.0f); }
};

/// Serves one bucket after another.
class SampleLayers {
public:
  explicit SampleLayers(const LayerSettings& settings);
  /// Forgets everything: there are `count` samples now, without surfaces.
  void begin(size_t count);

  /// The planes of an image's channels, SampleField::kPadding longer than there are samples, for opaque
  /// surfaces to be painted into while no sample has layers.
  float* plane(int channel) { return planes_[static_cast<size_t>(channel)].data(); }
  /// No sample has layers: its opacities are all 1 where it has a surface, and not in the planes.
  bool plain() const { return plain_; }
  /// 1 where the opaque surface is matte; not while plain().
  float* matte() { return matte_.data(); }
  /// So many samples have got their first surfaces by painting.
  void painted(size_t count);

  /// From now on samples may have surfaces that are not plainly opaque: before the calls below.
  void make_layers();
  /// A surface beyond these depths would not change the samples.
  const float* limits() const { return settings_.midpoint ? second_.data() : depths(); }
  bool hides_what_is_behind(const Color& opacity) const;
  /// A surface that hides what is behind it.
  void cover(size_t sample, float z, const SampleSurface& surface);
  /// A surface that lets something through: its look, which may be that of many samples,
  uint32_t keep(const SampleSurface& surface);
  /// and where it is.
  void lay(size_t sample, float z, uint32_t look) {
    if (!(z < depths()[sample])) return;
    fragments_.push_back({z, first_[sample], look});
    first_[sample] = static_cast<uint32_t>(fragments_.size() - 1);
  }

  /// Whether nothing beyond z can be seen any more.
  bool hides(float z) const;
  /// Whether nothing beyond z can be seen in a window of rows of `width` samples.
  bool hides(const SampleWindow& window, size_t width, float z) const;

  /// For each row of `width` samples: outside there is nothing.
  std::span<const SampleSpan> find_filled(size_t width);
  /// Depths, colours and variables become those of all surfaces of a sample. Call once, in the end.
  void composite();
  /// The planes of all channels of an image, after composite(); several channels may share one.
  std::span<const float* const> finished();

private:
  /// A transparent surface over a sample.
  struct Fragment {
    float z;
    uint32_t next; ///< further fragments of the sample, which came before; kNone at the end
    uint32_t look;
  };
  static constexpr uint32_t kNone = 0xffffffffu;
  /// Floats of a look: Ci, Oi, matte, then variables.
  static constexpr size_t kMatte = 6, kVariables = 7;
  const float* look(uint32_t number) const { return looks_.data() + number * (kVariables + settings_.aovs); }

  const float* depths() const { return planes_[Image::kZ].data(); }
  void set(size_t sample, int channel, const Color& c);
  void set_variables(size_t sample, const float* values);
  void sort_fragments(size_t sample);
  void composite(size_t sample);
  float opaque_depth(size_t sample) const;

  LayerSettings settings_;
  size_t count_ = 0;
  /// A plane of samples for each channel of an image: of the nearest opaque surface (no z: none), in the end
  /// of all.
  std::vector<std::vector<float>> planes_;
  bool plain_ = true;
  std::vector<float> matte_;
  std::vector<float> second_; ///< depth of the opaque surface behind the nearest; for midpoints only
  std::vector<Fragment> fragments_;
  std::vector<uint32_t> first_; ///< of each sample: its latest fragment, or kNone
  std::vector<float> looks_;
  std::vector<Fragment> in_order_; ///< of one sample
  std::vector<SampleSpan> filled_;
  std::vector<const float*> finished_;
  size_t open_ = 0; ///< samples that a surface at any depth would change
  // Depths only become smaller, so that these hold for some time.
  mutable float farthest_ = kInfinity; ///< no depth is greater
  mutable size_t witness_ = 0;         ///< a sample that has been found far away
};

} // namespace render
