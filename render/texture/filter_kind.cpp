// Filter formulas: box, triangle, gaussian, catmull-rom and sinc as in RISpec 3.2, appendix E; b-spline and
// mitchell (Mitchell and Netravali, 1988, B = C = 1/3) are separable cubics scaled to the filter's width, and
// blackman-harris (Harris, 1978, four terms) fills it. lanczos has its zeros at whole pixels.
#include "render/texture/filter_kind.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

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

float sinc(float x) {
  return std::abs(x) < 1e-3f ? 1.0f : std::sin(x) / x;
}

float blackman_harris(float fraction) {
  float t = kPi * (1 + fraction);
  return 0.35875f - 0.48829f * std::cos(t) + 0.14128f * std::cos(2 * t) - 0.01168f * std::cos(3 * t);
}

/// The family of cubics of Mitchell and Netravali, for |x| up to 2.
float cubic(float x, float b, float c) {
  x = std::abs(x);
  if (x >= 2) return 0;
  if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
  return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

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

bool is_separable(FilterKind kind) {
  return kind != FilterKind::kCatmullRom && kind != FilterKind::kDisk && kind != FilterKind::kBessel &&
         kind != FilterKind::kFunction;
}

float catmull_rom(float r) {
  if (r >= 2) return 0;
  if (r < 1) return (1.5f * r - 2.5f) * r * r + 1;
  return ((-0.5f * r + 2.5f) * r - 4) * r + 2;
}

float axis_weight(FilterKind kind, float x, float width) {
  float part = std::abs(2 * x / width); // of the half width
  if (part > 1) return 0;
  switch (kind) {
  case FilterKind::kTriangle: return 1 - part;
  case FilterKind::kGaussian: return std::exp(-2 * part * part);
  case FilterKind::kSeparableCatmullRom: return catmull_rom(std::abs(x));
  case FilterKind::kBSpline: return cubic(2 * part, 1, 0);
  case FilterKind::kMitchell: return cubic(2 * part, 1.0f / 3, 1.0f / 3);
  case FilterKind::kSinc: return sinc(x);
  case FilterKind::kBlackmanHarris: return blackman_harris(part);
  case FilterKind::kLanczos: return sinc(kPi * x) * sinc(kPi * part);
  default: return 1;
  }
}

} // namespace render
