// Filters as functions: those of the hider.
#include "render/ri/filters.h"

#include "render/hider/filter.h"

#define RI_FILTER(function, kind)                                                                            \
  RtFloat function(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {                                   \
    return render::filter_weight({render::FilterKind::kind, xwidth, ywidth}, x, y);                          \
  }

extern "C" {
RI_FILTER(RiBoxFilter, kBox)
RI_FILTER(RiTriangleFilter, kTriangle)
RI_FILTER(RiGaussianFilter, kGaussian)
RI_FILTER(RiCatmullRomFilter, kCatmullRom)
RI_FILTER(RiSincFilter, kSinc)
RI_FILTER(RiBSplineFilter, kBSpline)
RI_FILTER(RiMitchellFilter, kMitchell)
RI_FILTER(RiDiskFilter, kDisk)
RI_FILTER(RiSeparableCatmullRomFilter, kSeparableCatmullRom)
RI_FILTER(RiBlackmanHarrisFilter, kBlackmanHarris)
RI_FILTER(RiLanczosFilter, kLanczos)
RI_FILTER(RiBesselFilter, kBessel)
}

namespace render::ri {

std::string_view filter_name(RtFilterFunc function) {
  constexpr std::pair<RtFilterFunc, std::string_view> kFilters[] = {
      {RiBoxFilter, "box"},
      {RiTriangleFilter, "triangle"},
      {RiGaussianFilter, "gaussian"},
      {RiCatmullRomFilter, "catmull-rom"},
      {RiSincFilter, "sinc"},
      {RiBSplineFilter, "b-spline"},
      {RiMitchellFilter, "mitchell"},
      {RiDiskFilter, "disk"},
      {RiSeparableCatmullRomFilter, "separable-catmull-rom"},
      {RiBlackmanHarrisFilter, "blackman-harris"},
      {RiLanczosFilter, "lanczos"},
      {RiBesselFilter, "bessel"}};
  for (auto [known, name] : kFilters)
    if (known == function) return name;
  return {};
}

} // namespace render::ri
