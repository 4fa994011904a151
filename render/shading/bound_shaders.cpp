// Loading and binding of a scene's shaders.
#include "render/shading/bound_shaders.h"

#include "render/shading/area_emitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace render {

namespace {

slvm::ShaderKind wanted_kind(RequestId id) {
  switch (id) {
  case RequestId::kDisplacement: return slvm::ShaderKind::kDisplacement;
  case RequestId::kLightSource:
  case RequestId::kAreaLightSource: return slvm::ShaderKind::kLight;
  case RequestId::kAtmosphere:
  case RequestId::kInterior:
  case RequestId::kExterior: return slvm::ShaderKind::kVolume;
  case RequestId::kImager: return slvm::ShaderKind::kImager;
  default: return slvm::ShaderKind::kSurface;
  }
}

const slvm::Param* find_param(const slvm::Shader& shader, const std::string& name) {
  for (const slvm::Param& p : shader.program().params)
    if (p.name == name) return &p;
  return nullptr;
}

/// What is done without a shader.
std::string_view instead_of(RequestId id) {
  switch (id) {
  case RequestId::kSurface: return "the default surface is drawn instead";
  case RequestId::kLightSource:
  case RequestId::kAreaLightSource: return "it gives no light";
  default: return "the picture is made without it";
  }
}

/// hpoints lose their weight; other numbers stay as they are.
std::vector<float> shader_numbers(const ShaderParam& p) {
  if (!p.declaration || !p.declaration->hpoint) return p.numbers;
  std::vector<float> out;
  for (size_t i = 0; i + 3 < p.numbers.size(); i += 4)
    for (size_t k = 0; k < 3; ++k)
      out.push_back(p.numbers[i + k] / p.numbers[i + 3]);
  return out;
}

} // namespace

slvm::Result<std::shared_ptr<const slvm::Shader>> ShaderCache::find(const std::string& name,
                                                                    const std::vector<std::string>& path) {
  auto key = std::pair(name, path);
  auto it = loaded_.find(key);
  if (it != loaded_.end()) return it->second;
  auto load = [&]() -> slvm::Result<std::shared_ptr<const slvm::Shader>> {
    auto bytes = loader_(name, path);
    if (!bytes) return slvm::Error{bytes.error()};
    auto shader = machine_.load(std::as_bytes(std::span(*bytes)));
    if (!shader) return slvm::Error{fmt::format("shader \"{}\": {}", name, shader.error())};
    return *shader;
  };
  return loaded_.emplace(key, load()).first->second;
}

class BoundShaders::Binder {
public:
  explicit Binder(BoundShaders& out) : out_(out) {}

  void bind_all(const PrimitiveList& primitives);
  const slvm::Instance* bind(const std::shared_ptr<const ShaderRequest>& request);

private:
  std::unique_ptr<const BoundAttributes> bind(const std::shared_ptr<const Attributes>& a);
  std::shared_ptr<const slvm::Shader> load(const ShaderRequest& request);
  std::unique_ptr<slvm::Instance> make(const ShaderRequest& request,
                                       std::shared_ptr<const slvm::Shader> shader,
                                       const std::set<std::string>& may_vary);
  bool param_value(const ShaderRequest& request, const slvm::Shader& shader, const ShaderParam& p,
                   slvm::ParamValue& out);
  std::shared_ptr<const slvm::LightEmitter> emitter_of(const ShaderRequest& request);
  /// For what old files do and other renderers put up with.
  void warn(slvm::SourceRange where, const ShaderRequest& request, std::string_view text) {
    if (!quiet_)
      out_.diagnostics_.warning(where, "rib-shader",
                                fmt::format("{}: {}", request_info(request.kind).name, text));
  }
  void error(slvm::SourceRange where, const ShaderRequest& request, std::string_view text) {
    if (!quiet_) out_.diagnostics_.error(where, fmt::format("{}: {}", request_info(request.kind).name, text));
  }

  BoundShaders& out_;
  std::set<std::string> variables_; ///< that primitives have
  bool quiet_ = false;              ///< what is wrong was said before
};

/// Sets of attributes with an instance that was bound too narrowly are bound again.
void BoundShaders::Binder::bind_all(const PrimitiveList& primitives) {
  std::set<const Pieces*> known;
  for (const PrimitiveList::Run& run : primitives.runs()) {
    if (!known.insert(run.pieces.get()).second) continue;
    const VarSource* last = nullptr; // the faces of a mesh have the same variables
    for (uint32_t k = 0; k < run.count; ++k) {
      const Primitive p = run.primitive(k);
      if (p.vars.source() == last) continue;
      last = p.vars.source();
      for (const PatchVar& v : p.vars)
        variables_.insert(v.name);
    }
  }
  std::set<const Attributes*> seen;
  for (const PrimitiveList::Run& run : primitives.runs()) {
    const std::shared_ptr<const Attributes>& a = run.state->attributes;
    if (!seen.insert(a.get()).second) continue;
    auto bound = bind(a);
    auto it = out_.attributes_.find(a.get());
    if (it != out_.attributes_.end() && it->second.back()->same_as(*bound)) continue;
    std::lock_guard lock(out_.mutex_);
    out_.attributes_[a.get()].push_back(std::move(bound));
  }
}

namespace {

std::bitset<slvm::kGlobalCount> read_by(const BoundAttributes& bound) {
  using slvm::Global;
  std::bitset<slvm::kGlobalCount> out;
  auto add = [&](Global g) { out.set(static_cast<size_t>(g)); };
  auto add_program = [&](const slvm::Program& p) {
    for (const slvm::Slot& slot : p.slots)
      if (Global g = slot.parameter ? Global::kCount : slvm::find_global(slot.name); g != Global::kCount)
        add(g);
    for (slvm::ShadeopId id : p.imports)
      if (p.plugins.find(id)) {
        out.set();
      } else if (p.plugins.info(id).name == "texture") { // without coordinates at s and t
        add(Global::ks);
        add(Global::kt);
      }
  };
  for (const slvm::Instance* shader :
       {bound.shaders.surface, bound.shaders.atmosphere, bound.shaders.interior, bound.shaders.exterior})
    if (shader) add_program(shader->program());
  for (const slvm::Instance* light : bound.lights) // which may run with values that surfaces send
    add_program(light->shader().program());
  for (Global g : {Global::kP, Global::kN, Global::kI, Global::kCs, Global::kOs})
    add(g);
  if (bound.shaders.interior || bound.shaders.exterior) add(Global::kNg); // the side that is seen
  return out;
}

using Called = bool (*)(const slvm::Program&, slvm::ShadeopId);

/// Whether it calls a function of which that is true.
bool calls(const slvm::Instance* shader, Called what) {
  if (!shader) return false;
  // What values made of the program; not of lights, to which surfaces may send others.
  const bool light = shader->shader().kind() == slvm::ShaderKind::kLight;
  const slvm::Program& p = light ? shader->shader().program() : shader->program();
  return std::ranges::any_of(p.imports, [&](slvm::ShadeopId id) { return what(p, id); });
}

bool lights_or_air_call(const BoundAttributes& bound, Called what) {
  return calls(bound.shaders.atmosphere, what) ||
         std::ranges::any_of(bound.lights, [&](const slvm::Instance* light) { return calls(light, what); });
}

bool any_calls(const BoundAttributes& bound, Called what) {
  return calls(bound.shaders.displacement, what) || calls(bound.shaders.surface, what) ||
         lights_or_air_call(bound, what);
}

bool has_effects(const slvm::Program& p, slvm::ShadeopId id) {
  return p.plugins.find(id) || (p.plugins.info(id).flags & slvm::kEffect);
}

/// Rays have footprints.
bool differentiates(const slvm::Program& p, slvm::ShadeopId id) {
  return p.plugins.info(id).flags & (slvm::kDerivative | slvm::kRays);
}

/// Random numbers go by the numbers of points.
bool is_random(const slvm::Program& p, slvm::ShadeopId id) {
  const slvm::ShadeopInfo& info = p.plugins.info(id);
  return info.kind == slvm::ShadeopKind::kKernel && (info.flags & slvm::kHiddenVarying);
}

PointNeeds needs_of(const BoundAttributes& bound) {
  const slvm::Instance* surface = bound.shaders.surface;
  const bool moves = surface && std::ranges::any_of(surface->program().slots, [](const slvm::Slot& s) {
                       return s.stored && !s.parameter && s.name == "P";
                     });
  if (bound.shaders.displacement || bound.has_effects || moves || any_calls(bound, is_random))
    return PointNeeds::kGrid;
  return any_calls(bound, differentiates) ? PointNeeds::kNeighbours : PointNeeds::kNothing;
}

} // namespace

std::unique_ptr<const BoundAttributes>
BoundShaders::Binder::bind(const std::shared_ptr<const Attributes>& a) {
  auto bound = std::make_unique<BoundAttributes>();
  bound->attributes = a;
  bound->shaders.displacement = bind(a->displacement);
  bound->shaders.surface = bind(a->surface);
  bound->shaders.atmosphere = bind(a->atmosphere);
  bound->shaders.interior = bind(a->interior);
  bound->shaders.exterior = bind(a->exterior);
  for (const auto& light : a->lights)
    if (const slvm::Instance* instance = bind(light)) bound->lights.push_back(instance);
  bound->read = read_by(*bound);
  bound->has_effects = any_calls(*bound, has_effects);
  bound->points_need = needs_of(*bound);
  bound->surface_differentiates_alone = !lights_or_air_call(*bound, differentiates);
  return bound;
}

const slvm::Instance* BoundShaders::Binder::bind(const std::shared_ptr<const ShaderRequest>& request) {
  if (!request) return nullptr;
  // Only this thread changes the map: it may read it without the lock.
  auto it = out_.instances_.find(request.get());
  const BoundRequest* last = it == out_.instances_.end() ? nullptr : &it->second.back();
  if (last && !last->instance) return nullptr; // it failed before, and that was said
  std::shared_ptr<const slvm::Shader> shader = load(*request);
  BoundRequest bound;
  if (last) bound.may_vary = last->may_vary;
  if (shader)
    for (const slvm::Param& p : shader->program().params)
      if (variables_.contains(p.name)) bound.may_vary.insert(p.name);
  if (last && bound.may_vary == last->may_vary) return last->instance.get();
  quiet_ = last;
  if (shader) bound.instance = make(*request, shader, bound.may_vary);
  quiet_ = false;
  const slvm::Instance* instance = bound.instance.get();
  std::lock_guard lock(out_.mutex_);
  out_.instances_[request.get()].push_back(std::move(bound));
  return instance;
}

/// Null: reported.
std::shared_ptr<const slvm::Shader> BoundShaders::Binder::load(const ShaderRequest& request) {
  std::vector<std::string> path;
  const auto& paths = out_.options_.search_paths;
  if (auto it = paths.find("shader"); it != paths.end()) path = it->second;
  if (path.empty()) path = {"."};
  auto shader = out_.cache_.find(request.name, path);
  if (!shader) {
    // A missing shader is often named by every object: once is enough.
    if (!out_.missing_.insert(request.name).second) return nullptr;
    std::string text = fmt::format("{}; {}", shader.error(), instead_of(request.kind));
    if (shader.error() == no_such_shader(request.name, path).text)
      warn(request.where, request, text);
    else
      error(request.where, request, text);
    return nullptr;
  }
  slvm::ShaderKind kind = (*shader)->kind(), wanted = wanted_kind(request.kind);
  if (kind != wanted) {
    error(request.where, request,
          fmt::format("\"{}\" is a {} shader, not a {} shader", request.name, slvm::shader_kind_name(kind),
                      slvm::shader_kind_name(wanted)));
    return nullptr;
  }
  return *shader;
}

std::unique_ptr<slvm::Instance> BoundShaders::Binder::make(const ShaderRequest& request,
                                                           std::shared_ptr<const slvm::Shader> shader,
                                                           const std::set<std::string>& may_vary) {
  std::vector<slvm::ParamValue> values;
  for (const ShaderParam& p : request.params)
    if (slvm::ParamValue value; param_value(request, *shader, p, value)) values.push_back(std::move(value));
  slvm::InstanceOptions options{request.shader_to_camera, {may_vary.begin(), may_vary.end()}};
  if (request.kind == RequestId::kAreaLightSource) options.emitter = emitter_of(request);
  auto instance = out_.machine_.instantiate(shader, values, options);
  if (!instance) {
    error(request.where, request, fmt::format("shader \"{}\": {}", request.name, instance.error()));
    return nullptr;
  }
  return std::move(*instance);
}

std::shared_ptr<const slvm::LightEmitter> BoundShaders::Binder::emitter_of(const ShaderRequest& request) {
  auto it = out_.emitters_.find(&request);
  if (it != out_.emitters_.end()) return it->second;
  warn(request.where, request,
       fmt::format("\"{}\" has no surface: no primitive follows, or none with an area; it shines from the "
                   "origin of its space",
                   request.name));
  return nullptr;
}

/// A value with the type the scene declares or, if it does not, the shader's own. False: unusable, and
/// reported; the shader's default is then used.
bool BoundShaders::Binder::param_value(const ShaderRequest& request, const slvm::Shader& shader,
                                       const ShaderParam& p, slvm::ParamValue& out) {
  const slvm::Param* declared = find_param(shader, p.name);
  if (!declared) {
    std::vector<std::string_view> names;
    for (const slvm::Param& q : shader.program().params)
      names.push_back(q.name);
    std::string_view near = slvm::nearest_name(p.name, names);
    warn(p.where, request,
         fmt::format("shader \"{}\" has no parameter \"{}\"{}", request.name, p.name,
                     near.empty() ? "; it is ignored" : fmt::format("; did you mean \"{}\"?", near)));
    return false;
  }
  out.name = p.name;
  out.value.type = p.declaration ? p.declaration->type : declared->type;
  out.value.elements = p.declaration ? p.declaration->elements : declared->elements;
  // A predeclared or outdated declaration must not stop a value that the shader can take: same count, both
  // numbers.
  bool text = declared->type == slvm::Type::kString;
  out.value.numbers = shader_numbers(p);
  out.value.strings = p.strings;
  size_t want = (text ? 1 : static_cast<size_t>(slvm::components(declared->type))) *
                (declared->elements ? declared->elements : 1);
  size_t have = text ? p.strings.size() : out.value.numbers.size();
  if (have != want) {
    error(p.where, request,
          fmt::format("parameter \"{}\" of shader \"{}\" takes {} {}{}, found {}", p.name, request.name, want,
                      text ? "string" : "number", want == 1 ? "" : "s", have));
    return false;
  }
  bool same_size = slvm::components(out.value.type) == slvm::components(declared->type);
  bool both_text = (out.value.type == slvm::Type::kString) == text;
  // "background" is predeclared as a color; the value itself tells that here it is a file.
  bool says_so = text && !p.strings.empty();
  if ((same_size && both_text) || says_so) {
    out.value.type = declared->type;
    out.value.elements = declared->elements;
  }
  return true;
}

BoundShaders::BoundShaders(const Scene& scene, const slvm::Machine& machine, ShaderCache& cache,
                           slvm::Diagnostics& diagnostics)
    : options_(scene.options), machine_(machine), cache_(cache), diagnostics_(diagnostics) {
  add(scene.primitives);
  Binder(*this).bind(scene.options.imager);
}

/// The surfaces of area lights. All of a light are there when the first of them is: those of procedurals are
/// made before.
void BoundShaders::find_emitters(const PrimitiveList& primitives) {
  std::vector<const ShaderRequest*> order;
  std::unordered_map<const ShaderRequest*, PrimitiveList> surfaces;
  for (const PrimitiveList::Run& run : primitives.runs())
    if (const ShaderRequest* light = run.attributes().area_light.get()) {
      PrimitiveList& surface = surfaces[light];
      if (surface.empty()) order.push_back(light);
      surface.add(run.state, run.pieces);
    }
  DiceContext context;
  context.strings = &machine_.strings();
  context.time = options_.shutter_open + options_.shutter_offset;
  context.dtime = options_.shutter_close - options_.shutter_open;
  for (const ShaderRequest* light : order) {
    if (emitters_.contains(light)) continue;
    PrimitiveList& surface = surfaces[light];
    if (std::any_of(surface.runs().begin(), surface.runs().end(),
                    [](const PrimitiveList::Run& run) { return run.attributes().displacement != nullptr; }))
      diagnostics_.warning(light->where, "rib-shader",
                           "AreaLightSource: its surface sends light from where it is without displacement");
    auto emitter = std::make_shared<const AreaEmitter>(std::move(surface), light->samples, context);
    if (emitter->area() > 0) emitters_[light] = std::move(emitter);
  }
}

void BoundShaders::add(const PrimitiveList& primitives) {
  find_emitters(primitives);
  Binder(*this).bind_all(primitives);
}

const BoundAttributes* BoundShaders::find(const Attributes* attributes) const {
  std::shared_lock lock(mutex_);
  auto it = attributes_.find(attributes);
  return it == attributes_.end() ? nullptr : it->second.back().get();
}

const slvm::Instance* BoundShaders::find(const ShaderRequest& request) const {
  std::shared_lock lock(mutex_);
  auto it = instances_.find(&request);
  return it == instances_.end() ? nullptr : it->second.back().instance.get();
}

} // namespace render
