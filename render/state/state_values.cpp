// The standard names: RISpec 3.2, section 15.8, and the "Ri:" prefix of later renderers.
#include "render/state/state_values.h"

#include <fmt/format.h>

namespace render {

namespace {

/// What Option "trace" is where nobody sets it.
constexpr int kMostRayDepth = 10;
constexpr float kSpecularThreshold = 10;

using slvm::Type;
using slvm::Value;

Value number(float x) {
  return {Type::kFloat, 0, {x}, {}};
}
Value number(int x) {
  return number(static_cast<float>(x));
}
Value numbers(std::vector<float> x) {
  auto n = static_cast<uint32_t>(x.size());
  return {Type::kFloat, n, std::move(x), {}};
}
Value colour(Color c) {
  return {Type::kColor, 0, {c.x, c.y, c.z}, {}};
}
Value text(std::string_view s) {
  return {Type::kString, 0, {}, {std::string(s)}};
}

std::string_view without_prefix(std::string_view name) {
  if (name.starts_with("Ri:")) name.remove_prefix(3);
  return name;
}

std::string_view orientation_name(Orientation o) {
  constexpr std::string_view kNames[] = {"outside", "inside", "lh", "rh"};
  return kNames[static_cast<size_t>(o)];
}

std::optional<Value> named_value(const std::map<std::string, Value>& named, std::string_view name) {
  auto it = named.find(std::string(name));
  if (it == named.end()) return {};
  return it->second;
}

} // namespace

std::optional<Value> option_value(const Options& o, std::string_view name) {
  std::string_view n = without_prefix(name);
  if (n == "Format") return numbers({static_cast<float>(o.xres), static_cast<float>(o.yres), o.pixel_aspect});
  if (n == "CropWindow") return numbers({o.crop.begin(), o.crop.end()});
  if (n == "FrameAspectRatio") return number(o.aspect());
  if (n == "Shutter") return numbers({o.shutter_open, o.shutter_close});
  if (n == "Clipping") return numbers({o.near_plane, o.far_plane});
  if (n == "PixelSamples") return numbers({static_cast<float>(o.xsamples), static_cast<float>(o.ysamples)});
  if (n == "DepthOfField") return numbers({o.fstop, o.focal_length, o.focal_distance});
  if (n == "RelativeDetail") return number(o.relative_detail);
  if (n == "Frame") return number(o.frame);
  if (auto given = named_value(o.named, name)) return given;
  if (n == "trace:maxdepth") return number(kMostRayDepth);
  if (n == "trace:specularthreshold") return number(kSpecularThreshold);
  if (n == "trace:minweight") return number(0);
  return {};
}

std::optional<Value> attribute_value(const Attributes& a, std::string_view name) {
  std::string_view n = without_prefix(name);
  if (n == "ShadingRate") return number(a.shading_rate);
  if (n == "Sides") return number(a.sides);
  if (n == "Matte" || n == "matte") return number(a.matte ? 1 : 0);
  if (n == "Detail") return number(a.detail.size);
  if (n == "DetailRange") return numbers({a.detail.range.begin(), a.detail.range.end()});
  if (n == "GeometricApproximation:motionfactor") return number(a.dicing.motion_factor);
  if (n == "GeometricApproximation:focusfactor") return number(a.dicing.focus_factor);
  if (n == "Color") return colour(a.color);
  if (n == "Opacity") return colour(a.opacity);
  if (n == "TextureCoordinates") return numbers({a.texture_coordinates.begin(), a.texture_coordinates.end()});
  if (n == "Orientation") return text(orientation_name(a.orientation));
  if (n == "ShadingInterpolation") return text(a.smooth_shading ? "smooth" : "constant");
  // Transmission as it was given: a number or a name.
  if (auto given = named_value(a.named, name); given && name == "visibility:transmission") return given;
  if (auto value = ray_attribute_value(a.rays, name)) return value;
  return named_value(a.named, name);
}

std::string text_of(const Value& value) {
  if (value.type == Type::kString) return fmt::format("{}", fmt::join(value.strings, " "));
  return fmt::format("{:g}", fmt::join(value.numbers, " "));
}

} // namespace render
