// What becomes of filtered pixels: exposure, then the imager shader (RISpec 3.2, figure 4.2).
#pragma once

#include "render/hider/image.h"
#include "render/shading/grid_shader.h"
#include "render/state/options.h"

#include <array>
#include <span>
#include <vector>

namespace render {

class AfterFilter {
public:
  /// Both must outlive this.
  AfterFilter(const Options& options, std::span<const AovChannel> aovs);
  /// Of the pixels of `rect`, once. `scratch` is overwritten.
  void run(const PixelRect& rect, Image& image, GridShader& shader, slvm::Grid& scratch) const;

private:
  /// A picture, by the places of its first colour, opacity and alpha in a pixel.
  struct Picture {
    int Ci, Oi, alpha;
  };
  std::vector<Picture> find_pictures() const;
  void expose_all(const PixelRect& rect, Image& image) const;
  static void expose(const PixelRect& rect, int first, int count, const std::array<float, 2>& exposure,
                     Image& image);
  void run_imager(const PixelRect& rect, const Picture& picture, Image& image, GridShader& shader,
                  slvm::Grid& grid) const;

  const Options& options_;
  std::span<const AovChannel> aovs_;
  std::vector<Picture> pictures_;
};

} // namespace render
