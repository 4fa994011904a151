// What programs answer subsurface() with: lookups over the trees of stdlib/subsurface. One for each frame;
// the clouds are a CloudCache's, which lives as long as the program.
#pragma once

#include "slvm/subsurface.h"
#include "stdlib/subsurface/lit_cloud.h"

#include <functional>

namespace subsurface {

class CloudLookups : public slvm::SubsurfaceServices {
public:
  /// `find` turns the name in a shader into a path. The cache must outlive this.
  explicit CloudLookups(CloudCache& cache, std::function<std::string(std::string_view)> find = {})
      : clouds_(cache), find_(std::move(find)) {}

  std::string subsurface(const slvm::SubsurfaceLookup& lookup) override;

private:
  FrameClouds clouds_;
  std::function<std::string(std::string_view)> find_;
};

} // namespace subsurface
