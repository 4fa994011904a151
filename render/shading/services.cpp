// RendererServices over a scene. Names of attributes and options: RISpec 3.2, section 15.8, and the
// "category:name" form of later renderers.
#include "render/shading/services.h"

namespace render {

namespace {

using slvm::Type;
using slvm::Value;

const Primitive* primitive_of(const slvm::ShadingState& state) {
  return static_cast<const Primitive*>(state.grid.user);
}

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

} // namespace

SceneServices::SceneServices(const Scene& scene, const BoundShaders& shaders, slvm::TextureServices& textures,
                             std::function<void(std::string_view)> print)
    : scene_(scene), shaders_(shaders), textures_(textures), print_(std::move(print)) {
  auto add = [&](const std::string& name, const Matrix4& to_camera) {
    spaces_[name] = {to_camera, inverse_or_identity(to_camera)};
  };
  for (const auto& [name, m] : scene.spaces)
    add(name, m);
  Camera camera(scene.options);
  add("camera", {});
  add("world", scene.world_to_camera);
  spaces_["screen"] = {inverse_or_identity(camera.to_screen()), camera.to_screen()};
  spaces_["NDC"] = {inverse_or_identity(camera.to_ndc()), camera.to_ndc()};
  spaces_["raster"] = {inverse_or_identity(camera.to_raster()), camera.to_raster()};

  const Options& o = scene.options;
  options_["Format"] = numbers({static_cast<float>(o.xres), static_cast<float>(o.yres), o.pixel_aspect});
  options_["CropWindow"] = numbers({o.crop.begin(), o.crop.end()});
  options_["FrameAspectRatio"] = number(o.aspect());
  options_["Shutter"] = numbers({o.shutter_open, o.shutter_close});
  options_["Clipping"] = numbers({o.near_plane, o.far_plane});
  options_["PixelSamples"] = numbers({static_cast<float>(o.xsamples), static_cast<float>(o.ysamples)});
  options_["DepthOfField"] = numbers({kInfinity, 0, 0});
  options_["Frame"] = number(o.frame);
}

bool SceneServices::space_to_current(const slvm::ShadingState& state, std::string_view space, Matrix4& m) {
  if (const Primitive* p = primitive_of(state)) {
    const auto& scoped = p->attributes().scoped_spaces;
    if (auto it = scoped.find(std::string(space)); it != scoped.end()) {
      m = it->second;
      return true;
    }
  }
  auto it = spaces_.find(space);
  if (it == spaces_.end()) return false;
  m = it->second.to_camera;
  return true;
}

bool SceneServices::current_to_space(const slvm::ShadingState& state, std::string_view space, Matrix4& m) {
  if (const Primitive* p = primitive_of(state)) {
    const auto& scoped = p->attributes().scoped_spaces;
    if (auto it = scoped.find(std::string(space)); it != scoped.end()) {
      m = inverse_or_identity(it->second);
      return true;
    }
  }
  auto it = spaces_.find(space);
  if (it == spaces_.end()) return false;
  m = it->second.from_camera;
  return true;
}

std::span<const slvm::Instance* const> SceneServices::lights(const slvm::ShadingState& state) {
  const Primitive* p = primitive_of(state);
  const BoundAttributes* bound = p ? shaders_.find(&p->attributes()) : nullptr;
  if (!bound) return {};
  return bound->lights;
}

bool SceneServices::attribute(const slvm::ShadingState& state, std::string_view name, Value& out) {
  const Primitive* p = primitive_of(state);
  if (!p) return false;
  const Attributes& a = p->attributes();
  std::string_view n = without_prefix(name);
  if (n == "ShadingRate")
    out = number(a.shading_rate);
  else if (n == "Sides")
    out = number(a.sides);
  else if (n == "Matte" || n == "matte")
    out = number(a.matte ? 1 : 0);
  else if (n == "Color")
    out = colour(a.color);
  else if (n == "Opacity")
    out = colour(a.opacity);
  else if (n == "TextureCoordinates")
    out = numbers({a.texture_coordinates.begin(), a.texture_coordinates.end()});
  else if (n == "Orientation")
    out = text(orientation_name(a.orientation));
  else if (n == "ShadingInterpolation")
    out = text(a.smooth_shading ? "smooth" : "constant");
  else if (n == "Transformation") {
    Matrix4 to_world = p->state->object_to_camera * inverse_or_identity(scene_.world_to_camera);
    out = {Type::kMatrix, 0, {to_world.m.begin(), to_world.m.end()}, {}};
  } else {
    auto it = a.named.find(std::string(name));
    if (it == a.named.end()) return false;
    out = it->second;
  }
  return true;
}

bool SceneServices::option(const slvm::ShadingState&, std::string_view name, Value& out) {
  if (auto it = options_.find(without_prefix(name)); it != options_.end()) {
    out = it->second;
    return true;
  }
  auto it = scene_.options.named.find(std::string(name));
  if (it == scene_.options.named.end()) return false;
  out = it->second;
  return true;
}

bool SceneServices::renderer_info(const slvm::ShadingState&, std::string_view name, Value& out) {
  if (name == "renderer")
    out = text("Anemone");
  else if (name == "version")
    out = numbers({0, 1, 0, 0});
  else if (name == "versionstring")
    out = text("0.1.0");
  else
    return false;
  return true;
}

void SceneServices::print(const slvm::ShadingState&, std::string_view printed) {
  std::lock_guard lock(print_mutex_);
  if (print_) print_(printed);
}

} // namespace render
