// Lookups in textures by OpenImageIO's texture system.
#include "render/oiio/functions.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <set>

namespace render::oiio {

using slvm::TextureLookup;
using slvm::Type;
using slvm::Value;

namespace {

/// OpenImageIO's texture system with a cache of its own. Never destroyed, but used again: threads remember
/// what they hold of a system by its address, and OpenImageIO 2.4 takes that of a destroyed one for that of a
/// new one at the same place.
class System {
public:
  System() : textures_(OIIO::TextureSystem::create(false)) {
    textures_->attribute("automip", 1);     // ordinary images get their levels
    textures_->attribute("autotile", 64);   // and are kept in tiles
    textures_->attribute("gray_to_rgb", 0); // absent channels are filled: RISpec 3.2, table 15.1
  }
  System(const System&) = delete;

  /// Forgets all files, which may have changed.
  void forget() {
    textures_->invalidate_all(true);
    textures_->reset_stats();
    files_.clear();
  }
  /// Counts a file that is used.
  void use(const std::string& file) {
    std::lock_guard lock(mutex_);
    files_.insert(file);
  }
  size_t files() const { return files_.size(); }

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
  std::set<std::string> files_;
  OIIO::TextureSystem* textures_;
};

/// The systems that nobody uses at the moment.
class Pool {
public:
  System* take(float memory_megabytes) {
    System* out = nullptr;
    {
      std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        out = idle_.back();
        idle_.pop_back();
      }
    }
    if (!out) out = new System;
    (*out)->attribute("max_memory_MB", memory_megabytes);
    return out;
  }
  void give_back(System* system) {
    system->forget();
    std::lock_guard lock(mutex_);
    idle_.push_back(system);
  }

private:
  std::mutex mutex_;
  std::vector<System*> idle_;
};

Pool& pool() {
  static auto* the_pool = new Pool; // outlives all threads
  return *the_pool;
}

/// A region of the map: its middle and how s and t change along its sides.
struct Footprint {
  float s, t, s_u, t_u, s_v, t_v;
  bool is_point() const { return s_u == 0 && t_u == 0 && s_v == 0 && t_v == 0; }
  bool has_place() const { return std::isfinite(s) && std::isfinite(t); }
  /// OpenImageIO aborts when it is to blur a region that has a length but no width, or sides that are not
  /// numbers.
  void make_usable() {
    if (!std::isfinite(s_u) || !std::isfinite(t_u)) s_u = t_u = 0;
    if (!std::isfinite(s_v) || !std::isfinite(t_v)) s_v = t_v = 0;
    float along_u = std::hypot(s_u, t_u), along_v = std::hypot(s_v, t_v),
          longest = std::max(along_u, along_v);
    constexpr float kThin = 1e-3f; // thinner than any filter is
    if (longest == 0 || std::abs(s_u * t_v - t_u * s_v) > kThin * longest * longest) return;
    if (along_v > along_u) s_u = s_v, t_u = t_v;
    s_v = -kThin * t_u;
    t_v = kThin * s_u;
  }
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

/// Looks up every active point; `at(point)` gives its footprint.
template <class F>
std::string look_up(System& system, const std::string& file, const TextureLookup& l,
                    OIIO::TextureOpt::Wrap swrap, OIIO::TextureOpt::Wrap twrap, F&& at) {
  OIIO::TextureSystem::Perthread* thread = system->get_perthread_info();
  OIIO::TextureSystem::TextureHandle* map = system->get_texture_handle(OIIO::ustring(file), thread);
  if (!map || !system->good(map)) return system.problem(l.map);
  system.use(file);
  const OIIO::TextureOpt plain = options_of(l);
  for (size_t i = 0; i < l.points; ++i) {
    if (!l.active(i)) continue;
    Footprint f = at(i);
    if (!f.has_place()) {
      for (size_t c = 0; c < l.channels; ++c)
        l.result[c][i] = 0;
      continue;
    }
    OIIO::TextureOpt o = plain; // lookups change it
    o.swrap = swrap;
    o.twrap = twrap;
    o.sblur = TextureLookup::at(l.sblur, i);
    o.tblur = TextureLookup::at(l.tblur, i);
    if (o.sblur != 0 || o.tblur != 0) f.make_usable();
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

bool read_matrix(const OIIO::ImageSpec& spec, const char* name, slvm::Matrix4& m) {
  const OIIO::ParamValue* p = spec.find_attribute(name, OIIO::TypeMatrix);
  if (!p) return false;
  std::copy_n(static_cast<const float*>(p->data()), 16, m.m.begin());
  return true;
}

// From the image plane of "screen" space to x right and y up, -1 to 1 in the picture: "screen" is so already.
Value matrix_value(const slvm::Matrix4& m) {
  return {Type::kMatrix, 0, {m.m.begin(), m.m.end()}, {}};
}

class Lookups : public ImageLookups {
public:
  explicit Lookups(float memory_megabytes) : system_(*pool().take(memory_megabytes)) {}
  ~Lookups() override { pool().give_back(&system_); }

  std::string texture(const std::string& file, const TextureLookup& l) override {
    return look_up(system_, file, l, OIIO::TextureOpt::WrapDefault, OIIO::TextureOpt::WrapDefault,
                   [&](size_t i) {
                     return Footprint{l.centre[0][i],  l.centre[1][i],  l.along_u[0][i],
                                      l.along_u[1][i], l.along_v[0][i], l.along_v[1][i]};
                   });
  }
  std::string environment(const std::string& file, const TextureLookup& l) override {
    return look_up(system_, file, l, OIIO::TextureOpt::WrapPeriodic, OIIO::TextureOpt::WrapClamp,
                   [&](size_t i) { return latlong(l, i); });
  }
  bool info(const std::string& file, std::string_view field, const slvm::Matrix4& current_to_world,
            Value& out) override {
    OIIO::ImageSpec spec;
    if (!system_->get_imagespec(OIIO::ustring(file), 0, spec)) {
      system_->geterror();
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

  std::pair<long long, long long> usage() override {
    long long bytes = 0;
    system_->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
    return {static_cast<long long>(system_.files()), bytes};
  }

private:
  System& system_;
};

} // namespace

std::unique_ptr<ImageLookups> make_lookups(float memory_megabytes) {
  return std::make_unique<Lookups>(memory_megabytes);
}

} // namespace render::oiio
