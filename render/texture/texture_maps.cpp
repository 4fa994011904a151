#include "render/texture/texture_maps.h"

#include "render/texture/depth_image.h"
#include "render/texture/find_image.h"
#include "render/texture/shadow_map.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace render {

using slvm::TextureLookup;
using slvm::Type;
using slvm::Value;

/// OpenImageIO's texture system, owned.
class TextureMaps::System {
public:
  explicit System(const Settings& settings) : textures_(OIIO::TextureSystem::create(false)) {
    textures_->attribute("automip", 1);   // ordinary images get their levels
    textures_->attribute("autotile", 64); // and are kept in tiles
    textures_->attribute("max_memory_MB", settings.memory_megabytes);
    textures_->attribute("gray_to_rgb", 0); // absent channels are filled: RISpec 3.2, table 15.1
  }
  ~System() { OIIO::TextureSystem::destroy(textures_, true); } // with its cache, which nobody shares
  System(const System&) = delete;

  OIIO::TextureSystem* operator->() const { return textures_; }

  /// Why the map cannot be used, in one line: what OpenImageIO said the first time, since it says so only
  /// once.
  std::string problem(std::string_view map) {
    std::string text = textures_->geterror();
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (text.ends_with(' '))
      text.pop_back();
    std::lock_guard lock(mutex_);
    return problems_.try_emplace(std::string(map), text.empty() ? "cannot be read" : text).first->second;
  }

private:
  std::mutex mutex_;
  std::map<std::string, std::string> problems_;
  OIIO::TextureSystem* textures_;
};

namespace {

constexpr std::string_view kRays = "raytrace";
constexpr const char* kNoRays = "asks for rays, which nobody traces here";

/// A region of the map: its middle and how s and t change along its sides.
struct Footprint {
  float s, t, s_u, t_u, s_v, t_v;
  bool is_point() const { return s_u == 0 && t_u == 0 && s_v == 0 && t_v == 0; }
};

// OpenImageIO chooses the level by the region; the filter within a level is its nearest relative of what is
// asked for.
OIIO::TextureOpt options_of(const TextureLookup& l) {
  OIIO::TextureOpt o;
  const slvm::TextureOptions& given = l.options;
  o.firstchannel = static_cast<int>(l.first_channel);
  o.fill = given.fill;
  o.interpmode = given.filter == "gaussian" || given.filter == "catmull-rom"
                     ? OIIO::TextureOpt::InterpBicubic
                     : OIIO::TextureOpt::InterpBilinear;
  o.mipmode = given.between_levels ? OIIO::TextureOpt::MipModeAniso : OIIO::TextureOpt::MipModeOneLevel;
  if (given.samples >= 1) o.anisotropic = static_cast<int>(std::min(given.samples, 256.0f));
  return o;
}

// One sample of a point is the texel itself, as z-buffers are read.
void set_point_mode(OIIO::TextureOpt& o, const TextureLookup& l, bool is_point) {
  if (!is_point || l.options.samples != 1) return;
  o.interpmode = OIIO::TextureOpt::InterpClosest;
  o.mipmode = OIIO::TextureOpt::MipModeNoMIP;
}

} // namespace

TextureMaps::TextureMaps(const Settings& settings) : settings_(settings) {}
TextureMaps::~TextureMaps() = default;

std::string TextureMaps::file_of(std::string_view map) {
  std::lock_guard lock(files_mutex_);
  auto it = files_.find(map);
  if (it != files_.end()) return it->second;
  std::string file = find_image(map, settings_.folders).value_or(std::string(map));
  // The same name in a folder of the path is no replacement.
  if (file != map && !file.ends_with("/" + std::string(map))) replaced_[std::string(map)] = file;
  return files_.emplace(std::string(map), std::move(file)).first->second;
}

std::map<std::string, std::string> TextureMaps::replaced() {
  std::lock_guard lock(files_mutex_);
  return replaced_;
}

TextureMaps::Usage TextureMaps::usage() {
  if (!system_) return {};
  Usage out;
  int files = 0;
  (*system_)->getattribute("stat:unique_files", OIIO::TypeDesc::INT, &files);
  (*system_)->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &out.bytes);
  out.files = files;
  return out;
}

TextureMaps::System& TextureMaps::system() {
  std::call_once(system_made_, [&] { system_ = std::make_unique<System>(settings_); });
  return *system_;
}

namespace {

/// Looks up every active point; `at(point)` gives its footprint.
template <class System, class F>
std::string look_up(System& system, const std::string& file, const TextureLookup& l,
                    OIIO::TextureOpt::Wrap swrap, OIIO::TextureOpt::Wrap twrap, F&& at) {
  OIIO::TextureSystem::Perthread* thread = system->get_perthread_info();
  OIIO::TextureSystem::TextureHandle* map = system->get_texture_handle(OIIO::ustring(file), thread);
  if (!map || !system->good(map)) return system.problem(l.map);
  const OIIO::TextureOpt plain = options_of(l);
  for (size_t i = 0; i < l.points; ++i) {
    if (!l.active(i)) continue;
    Footprint f = at(i);
    OIIO::TextureOpt o = plain; // lookups change it
    o.swrap = swrap;
    o.twrap = twrap;
    o.sblur = TextureLookup::at(l.sblur, i);
    o.tblur = TextureLookup::at(l.tblur, i);
    set_point_mode(o, l, f.is_point() && o.sblur == 0 && o.tblur == 0);
    float result[TextureLookup::kMost] = {};
    if (!system->texture(map, thread, o, f.s, f.t, f.s_u, f.t_u, f.s_v, f.t_v, static_cast<int>(l.channels),
                         result))
      return system.problem(l.map);
    for (size_t c = 0; c < l.channels; ++c)
      l.result[c][i] = result[c];
  }
  return {};
}

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// Latitude-longitude coordinates of a direction and of how it changes.
Footprint latlong(const TextureLookup& l, size_t i) {
  float x = l.centre[0][i], y = l.centre[1][i], z = l.centre[2][i];
  float across = x * x + y * y, flat = std::sqrt(across), square = across + z * z;
  float longitude = std::atan2(y, x), latitude = std::atan2(z, flat);
  if (longitude < 0) longitude += kTurn;
  auto change = [&](const std::vector<float>(&d)[3], float& s, float& t) {
    float dx = d[0][i], dy = d[1][i], dz = d[2][i];
    s = across > 0 ? (x * dy - y * dx) / (across * kTurn) : 0;
    t = flat > 0 && square > 0 ? -(flat * dz - z * (x * dx + y * dy) / flat) / square * 2 / kTurn : 0;
    s = std::clamp(s, -1.0f, 1.0f); // next to a pole
  };
  Footprint f{longitude / kTurn, 0.5f - latitude * 2 / kTurn, 0, 0, 0, 0};
  change(l.along_u, f.s_u, f.t_u);
  change(l.along_v, f.s_v, f.t_v);
  return f;
}

} // namespace

std::string TextureMaps::texture(const TextureLookup& l) {
  return look_up(system(), file_of(l.map), l, OIIO::TextureOpt::WrapDefault, OIIO::TextureOpt::WrapDefault,
                 [&](size_t i) {
                   return Footprint{l.centre[0][i],  l.centre[1][i],  l.along_u[0][i],
                                    l.along_u[1][i], l.along_v[0][i], l.along_v[1][i]};
                 });
}

std::string TextureMaps::environment(const TextureLookup& l) {
  if (l.map == kRays) return kNoRays;
  return look_up(system(), file_of(l.map), l, OIIO::TextureOpt::WrapPeriodic, OIIO::TextureOpt::WrapClamp,
                 [&](size_t i) { return latlong(l, i); });
}

namespace {

bool read_matrix(const OIIO::ImageSpec& spec, const char* name, slvm::Matrix4& m) {
  const OIIO::ParamValue* p = spec.find_attribute(name, OIIO::TypeMatrix);
  if (!p) return false;
  std::copy_n(static_cast<const float*>(p->data()), 16, m.m.begin());
  return true;
}

std::shared_ptr<const ShadowMap> read_shadow_map(const std::string& path, std::string& problem) {
  DepthImage image;
  problem = read_depth_image(path, image);
  if (!problem.empty()) return nullptr;
  if (image.world_to_camera.empty() || image.world_to_screen.empty()) {
    problem = "is no shadow map: it lacks the matrices worldtocamera and worldtoscreen";
    return nullptr;
  }
  auto map = std::make_shared<ShadowMap>();
  std::copy_n(image.world_to_camera.begin(), 16, map->world_to_camera.m.begin());
  std::copy_n(image.world_to_screen.begin(), 16, map->world_to_screen.m.begin());
  map->width = image.width;
  map->height = image.height;
  map->depth = std::move(image.depth);
  return map;
}

} // namespace

std::shared_ptr<const ShadowMap> TextureMaps::shadow_map(const std::string& name, std::string& problem) {
  std::lock_guard lock(shadows_mutex_);
  auto [it, is_new] = shadows_.try_emplace(name);
  if (is_new) {
    it->second.map = read_shadow_map(file_of(name), it->second.problem);
  }
  problem = it->second.problem;
  return it->second.map;
}

std::string TextureMaps::shadow(const TextureLookup& l) {
  if (l.map == kRays) return kNoRays;
  std::string problem;
  std::shared_ptr<const ShadowMap> map = shadow_map(std::string(l.map), problem);
  if (!map) return problem;
  constexpr float kDefaultSamples = 16;
  for (size_t i = 0; i < l.points; ++i) {
    if (!l.active(i)) continue;
    ShadowMap::Region r{};
    auto world = slvm::transform_point(l.current_to_world, {l.centre[0][i], l.centre[1][i], l.centre[2][i]});
    auto u = slvm::transform_vector(l.current_to_world, {l.along_u[0][i], l.along_u[1][i], l.along_u[2][i]});
    auto v = slvm::transform_vector(l.current_to_world, {l.along_v[0][i], l.along_v[1][i], l.along_v[2][i]});
    std::copy(world.begin(), world.end(), r.centre);
    std::copy(u.begin(), u.end(), r.along_u);
    std::copy(v.begin(), v.end(), r.along_v);
    r.sblur = TextureLookup::at(l.sblur, i);
    r.tblur = TextureLookup::at(l.tblur, i);
    r.samples = static_cast<int>(
        std::clamp(l.options.samples > 0 ? l.options.samples : kDefaultSamples, 1.0f, 4096.0f));
    r.seed = static_cast<uint32_t>(i) * 0x9e3779b9u >> 8;
    float chance = static_cast<float>(r.seed * 0x85ebca6bu >> 8) * 0x1p-24f;
    r.bias = l.bias.empty() ? settings_.shadow_bias + settings_.shadow_bias_spread * chance
                            : TextureLookup::at(l.bias, i);
    float shadowed = map->shadowed(r);
    for (size_t c = 0; c < l.channels; ++c)
      l.result[c][i] = shadowed;
  }
  return {};
}

namespace {

// From the image plane of "screen" space to x right and y up, -1 to 1 in the picture: "screen" is so already.
Value matrix_value(const slvm::Matrix4& m) {
  return {Type::kMatrix, 0, {m.m.begin(), m.m.end()}, {}};
}

} // namespace

bool TextureMaps::info(std::string_view map, std::string_view field, const slvm::Matrix4& current_to_world,
                       Value& out) {
  OIIO::ImageSpec spec;
  if (!system()->get_imagespec(OIIO::ustring(file_of(map)), 0, spec)) {
    system()->geterror();
    return false;
  }
  slvm::Matrix4 m;
  if (field == "resolution") {
    out = {Type::kFloat, 2, {static_cast<float>(spec.width), static_cast<float>(spec.height)}, {}};
  } else if (field == "channels") {
    out = {Type::kFloat, 0, {static_cast<float>(spec.nchannels)}, {}};
  } else if (field == "type") {
    std::string kind = spec.get_string_attribute("textureformat");
    std::string name = kind == "Shadow"                ? "shadow"
                       : kind.find("Env") != kind.npos ? "environment"
                                                       : "texture";
    out = {Type::kString, 0, {}, {name}};
  } else if (field == "viewingmatrix" && read_matrix(spec, "worldtocamera", m)) {
    out = matrix_value(current_to_world * m);
  } else if (field == "projectionmatrix" && read_matrix(spec, "worldtoscreen", m)) {
    out = matrix_value(current_to_world * m);
  } else {
    return false;
  }
  return true;
}

} // namespace render
