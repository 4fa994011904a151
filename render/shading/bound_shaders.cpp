// Loading and binding of a scene's shaders.
#include "render/shading/bound_shaders.h"

#include <fmt/format.h>

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
  Binder(BoundShaders& out, const Scene& scene, const slvm::Machine& machine, ShaderCache& cache,
         slvm::Diagnostics& diagnostics)
      : out_(out), scene_(scene), machine_(machine), cache_(cache), diagnostics_(diagnostics) {}

  void run();

private:
  const slvm::Instance* bind(const std::shared_ptr<const ShaderRequest>& request);
  std::unique_ptr<slvm::Instance> make(const ShaderRequest& request);
  bool param_value(const ShaderRequest& request, const slvm::Shader& shader, const ShaderParam& p,
                   slvm::ParamValue& out);
  /// For what old files do and other renderers put up with.
  void warn(slvm::SourceRange where, const ShaderRequest& request, std::string_view text) {
    diagnostics_.warning(where, "rib-shader", fmt::format("{}: {}", request_info(request.kind).name, text));
  }
  void error(slvm::SourceRange where, const ShaderRequest& request, std::string_view text) {
    diagnostics_.error(where, fmt::format("{}: {}", request_info(request.kind).name, text));
  }

  BoundShaders& out_;
  const Scene& scene_;
  const slvm::Machine& machine_;
  ShaderCache& cache_;
  slvm::Diagnostics& diagnostics_;
  std::vector<std::string> may_vary_;
  std::set<std::string> missing_;
};

void BoundShaders::Binder::run() {
  std::set<std::string> names;
  for (const Primitive& p : scene_.primitives)
    for (const PatchVar& v : p.vars)
      names.insert(v.name);
  may_vary_.assign(names.begin(), names.end());
  for (const Primitive& p : scene_.primitives) {
    const Attributes* a = &p.attributes();
    if (out_.attributes_.contains(a)) continue;
    BoundAttributes& bound = out_.attributes_[a];
    bound.shaders.displacement = bind(a->displacement);
    bound.shaders.surface = bind(a->surface);
    bound.shaders.atmosphere = bind(a->atmosphere);
    for (const auto& light : a->lights)
      if (const slvm::Instance* instance = bind(light)) bound.lights.push_back(instance);
  }
  bind(scene_.options.imager);
}

const slvm::Instance* BoundShaders::Binder::bind(const std::shared_ptr<const ShaderRequest>& request) {
  if (!request) return nullptr;
  auto it = out_.instances_.find(request.get());
  if (it == out_.instances_.end()) it = out_.instances_.emplace(request.get(), make(*request)).first;
  return it->second.get();
}

std::unique_ptr<slvm::Instance> BoundShaders::Binder::make(const ShaderRequest& request) {
  std::vector<std::string> path;
  if (auto it = scene_.options.search_paths.find("shader"); it != scene_.options.search_paths.end())
    path = it->second;
  if (path.empty()) path = {"."};
  auto shader = cache_.find(request.name, path);
  if (!shader) {
    // A missing shader is often named by every object: once is enough.
    if (!missing_.insert(request.name).second) return nullptr;
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
  std::vector<slvm::ParamValue> values;
  for (const ShaderParam& p : request.params)
    if (slvm::ParamValue value; param_value(request, **shader, p, value)) values.push_back(std::move(value));
  auto instance = machine_.instantiate(*shader, values, {request.shader_to_camera, may_vary_});
  if (!instance) {
    error(request.where, request, fmt::format("shader \"{}\": {}", request.name, instance.error()));
    return nullptr;
  }
  return std::move(*instance);
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
  if (same_size && (out.value.type == slvm::Type::kString) == text) {
    out.value.type = declared->type;
    out.value.elements = declared->elements;
  }
  return true;
}

BoundShaders::BoundShaders(const Scene& scene, const slvm::Machine& machine, ShaderCache& cache,
                           slvm::Diagnostics& diagnostics) {
  Binder(*this, scene, machine, cache, diagnostics).run();
}

const BoundAttributes* BoundShaders::find(const Attributes* attributes) const {
  auto it = attributes_.find(attributes);
  return it == attributes_.end() ? nullptr : &it->second;
}

const slvm::Instance* BoundShaders::find(const ShaderRequest& request) const {
  auto it = instances_.find(&request);
  return it == instances_.end() ? nullptr : it->second.get();
}

} // namespace render
