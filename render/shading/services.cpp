// RendererServices over a scene. Names of attributes and options: state/state_values.h.
#include "render/shading/services.h"

#include "render/state/state_values.h"

namespace render {

namespace {

using slvm::Type;
using slvm::Value;

const Primitive* primitive_of(const slvm::ShadingState& state) {
  return static_cast<const Primitive*>(state.grid.user);
}

Value numbers(std::vector<float> x) {
  auto n = static_cast<uint32_t>(x.size());
  return {Type::kFloat, n, std::move(x), {}};
}
Value text(std::string_view s) {
  return {Type::kString, 0, {}, {std::string(s)}};
}

} // namespace

SceneServices::SceneServices(const Scene& scene, const BoundShaders& shaders, slvm::TextureServices& textures,
                             slvm::SubsurfaceServices& subsurface, slvm::PointCloudServices& point_clouds,
                             std::function<void(std::string_view)> print)
    : scene_(scene), shaders_(shaders), textures_(textures), subsurface_(subsurface),
      point_clouds_(point_clouds), print_(std::move(print)) {
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
}

void SceneServices::add_spaces(const std::map<std::string, Matrix4>& to_camera) {
  std::lock_guard lock(spaces_mutex_);
  for (const auto& [name, m] : to_camera)
    spaces_[name] = {m, inverse_or_identity(m)};
}

std::optional<SceneServices::Space> SceneServices::find_space(const slvm::ShadingState& state,
                                                              std::string_view name) const {
  if (const Primitive* p = primitive_of(state)) {
    const auto& scoped = p->attributes().scoped_spaces;
    if (auto it = scoped.find(std::string(name)); it != scoped.end())
      return Space{it->second, inverse_or_identity(it->second)};
  }
  std::shared_lock lock(spaces_mutex_);
  auto it = spaces_.find(name);
  if (it == spaces_.end()) return {};
  return it->second;
}

bool SceneServices::space_to_current(const slvm::ShadingState& state, std::string_view name, Matrix4& m) {
  auto space = find_space(state, name);
  if (space) m = space->to_camera;
  return space.has_value();
}

bool SceneServices::current_to_space(const slvm::ShadingState& state, std::string_view name, Matrix4& m) {
  auto space = find_space(state, name);
  if (space) m = space->from_camera;
  return space.has_value();
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
  if (name == "Transformation" || name == "Ri:Transformation") {
    Matrix4 to_world = p->state->object_to_camera * inverse_or_identity(scene_.world_to_camera);
    out = {Type::kMatrix, 0, {to_world.m.begin(), to_world.m.end()}, {}};
    return true;
  }
  auto value = attribute_value(p->attributes(), name);
  if (!value) return false;
  out = std::move(*value);
  return true;
}

bool SceneServices::option(const slvm::ShadingState&, std::string_view name, Value& out) {
  auto value = option_value(scene_.options, name);
  if (!value) return false;
  out = std::move(*value);
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
