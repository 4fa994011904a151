// Derived values of the options.
#include "render/state/options.h"

#include <utility>

namespace render {

namespace {

constexpr std::pair<std::string_view, FilterKind> kFilters[] = {
    {"box", FilterKind::kBox},
    {"triangle", FilterKind::kTriangle},
    {"gaussian", FilterKind::kGaussian},
    {"catmull-rom", FilterKind::kCatmullRom},
    {"separable-catmull-rom", FilterKind::kSeparableCatmullRom},
    {"b-spline", FilterKind::kBSpline},
    {"sinc", FilterKind::kSinc},
    {"mitchell", FilterKind::kMitchell},
    {"disk", FilterKind::kDisk},
    {"blackman-harris", FilterKind::kBlackmanHarris},
    {"lanczos", FilterKind::kLanczos},
    {"bessel", FilterKind::kBessel}};

} // namespace

std::optional<FilterKind> find_filter(std::string_view name) {
  for (auto [known, kind] : kFilters)
    if (known == name) return kind;
  return {};
}

std::string filter_names() {
  std::string out;
  for (auto [name, kind] : kFilters)
    out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

float Options::aspect() const {
  if (frame_aspect) return *frame_aspect;
  return static_cast<float>(xres) * pixel_aspect / static_cast<float>(yres);
}

std::array<float, 4> Options::window() const {
  if (screen_window) return *screen_window;
  float a = aspect();
  if (a >= 1) return {-a, a, -1, 1};
  return {-1, 1, -1 / a, 1 / a};
}

} // namespace render
