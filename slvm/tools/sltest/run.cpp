#include "slvm/tools/sltest/run.h"

#include "slvm/tools/sltest/obtain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace slvm::sltest {
namespace {

/// Predefined variables that a shader of each kind leaves behind, in the order of ShaderKind.
constexpr std::string_view kResults[kShaderKindCount][3] = {
    {"Ci", "Oi", ""}, {"P", "N", ""}, {"L", "Cl", ""}, {"Ci", "Oi", ""}, {"Ci", "Oi", "alpha"}};

const Param* find_param(const Program& program, std::string_view name) {
  auto it = std::find_if(program.params.begin(), program.params.end(),
                         [&](const Param& p) { return p.name == name; });
  return it == program.params.end() ? nullptr : &*it;
}

/// Parameter values in the types the shader declares; unknown ones go to the machine, which reports them.
bool param_values(const ShaderRef& ref, const Program& program, std::vector<ParamValue>& values,
                  RunError& error) {
  for (const Setting& s : ref.params) {
    Declaration d = s.what;
    if (const Param* p = find_param(program, d.name); p && !d.type) {
      d.type = p->type;
      d.elements = p->elements;
    }
    d = inferred_type(s.value, d);
    auto value = to_value(s.value, *d.type, d.elements);
    if (!value) {
      error = {Failure::kBind,
               fmt::format("{}: parameter '{}': {}", to_string(s.value.where), d.name, value.error())};
      return false;
    }
    std::erase_if(values, [&](const ParamValue& v) { return v.name == d.name; });
    values.push_back({d.name, *value});
  }
  return true;
}

} // namespace

std::string describe(const RunConfig& config) {
  std::string text = fmt::format("strips of {}, -O{}, {}", config.strip, config.opt_level,
                                 config.specialise ? "specialised" : "not specialised");
  if (!config.target.empty()) text += ", " + config.target;
  return text;
}

const Variable* RunResult::find(std::string_view name) const {
  auto it = std::find_if(outputs.begin(), outputs.end(), [&](const Variable& v) { return v.name == name; });
  return it == outputs.end() ? nullptr : &*it;
}

std::unique_ptr<Instance> Binding::bind(const Setup& setup, const ShaderRef& ref, ShaderLibrary& library,
                                        const RunConfig& config, RunError& error) {
  const std::vector<Formal> formals = primvar_formals(prepared_->grid);
  const bool marked = config.instrument_all || &ref == &setup.shader;
  const CompileMode mode{config.opt_level, marked ? config.instrumenter : nullptr};
  ShaderPtr compiled = obtain(setup, ref, formals, library, mode, error);
  if (!compiled) return nullptr;
  warnings_ += compiled->warnings;
  if (&ref == &setup.shader) main_warnings_ = compiled->warning_texts;
  auto shader = machine_.load(compiled->slo);
  if (!shader) {
    error = {Failure::kBind, shader.error()};
    return nullptr;
  }
  std::vector<ParamValue> values;
  if (!param_values(ref, (*shader)->program(), values, error)) return nullptr;
  InstanceOptions options;
  options.shader_to_current = ref.space;
  for (const Formal& f : formals)
    options.may_vary.push_back(f.name);
  auto instance = machine_.instantiate(*shader, values, options);
  if (!instance) {
    error = {Failure::kBind, instance.error()};
    return nullptr;
  }
  return std::move(*instance);
}

std::unique_ptr<Binding> Binding::make(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                                       const RunConfig& config, RunError& error) {
  MachineOptions options;
  options.strip_points = config.strip;
  options.target = config.target;
  options.specialise = config.specialise;
  options.plugin_folders = config.plugin_folders;
  std::unique_ptr<Binding> binding(new Binding(options));
  binding->prepared_ = &prepared;
  binding->main_ = binding->bind(setup, setup.shader, library, config, error);
  if (!binding->main_) return nullptr;
  ShaderSet& set = binding->set_;
  if (prepared.kind == ShaderKind::kSurface) set.surface = binding->main_.get();
  if (prepared.kind == ShaderKind::kDisplacement) set.displacement = binding->main_.get();

  const std::map<std::string, const Instance* ShaderSet::*> roles = {
      {"displacement", &ShaderSet::displacement},
      {"surface", &ShaderSet::surface},
      {"atmosphere", &ShaderSet::atmosphere},
      {"interior", &ShaderSet::interior},
      {"exterior", &ShaderSet::exterior}};
  for (const auto& [role, ref] : setup.companions) {
    binding->companions_.push_back(binding->bind(setup, ref, library, config, error));
    if (!binding->companions_.back()) return nullptr;
    if (set.*roles.at(role)) {
      error = {Failure::kSetup,
               fmt::format("{}: the shader under test is the {} already", to_string(ref.where), role)};
      return nullptr;
    }
    set.*roles.at(role) = binding->companions_.back().get();
  }
  for (const ShaderRef& ref : setup.lights) {
    binding->lights_.push_back(binding->bind(setup, ref, library, config, error));
    if (!binding->lights_.back()) return nullptr;
  }
  return binding->set_scene(setup, library, config, error) ? std::move(binding) : nullptr;
}

/// What rays see. Its shaders are compiled as those of the test are, without marks.
bool Binding::set_scene(const Setup& setup, ShaderLibrary& library, const RunConfig& config,
                        RunError& error) {
  if (setup.scene.empty()) return true;
  RaySceneRequest request;
  request.machine = &machine_;
  request.rib = setup.scene;
  request.name = setup.scene_where.file;
  request.path = setup.path;
  request.shader = [&](const std::string& name) -> Result<std::string> {
    ShaderError why;
    ShaderPtr shader = library.find(name, {config.opt_level, nullptr}, setup.path, why);
    if (!shader) return Error{why.text};
    return std::string(reinterpret_cast<const char*>(shader->slo.data()), shader->slo.size());
  };
  ray_scene_ = make_ray_scene(request);
  std::string problem =
      ray_scene_ ? ray_scene_->problem() : "without sltest_rays.so (the renderer) there are no scenes";
  if (problem.empty()) return true;
  error = {Failure::kSetup, fmt::format("{}: scene: {}", to_string(setup.scene_where), problem)};
  return false;
}

namespace {

std::vector<const Instance*> pointers(const std::vector<std::unique_ptr<Instance>>& instances) {
  std::vector<const Instance*> list;
  for (const auto& i : instances)
    list.push_back(i.get());
  return list;
}

} // namespace

Worker::Worker(const Binding& binding)
    : binding_(binding), services_(binding.prepared_->scene, pointers(binding.lights_),
                                   binding.ray_scene_ ? &binding.ray_scene_->rays() : nullptr,
                                   binding.ray_scene_ ? &binding.ray_scene_->irradiance_caches() : nullptr,
                                   binding.ray_scene_ ? &binding.ray_scene_->photon_maps() : nullptr),
      context_(binding.machine_, services_), grid_(binding.prepared_->grid.nu, binding.prepared_->grid.nv) {}

double Worker::shade() {
  const Prepared& prepared = *binding_.prepared_;
  grid_.reset(prepared.grid.nu, prepared.grid.nv);
  fill(grid_, prepared.grid, binding_.machine_.strings());
  services_.forget_printed();
  const auto start = std::chrono::steady_clock::now();
  if (prepared.kind == ShaderKind::kSurface || prepared.kind == ShaderKind::kDisplacement)
    context_.shade(binding_.set_, grid_);
  else
    context_.run(*binding_.main_, grid_);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::string> Worker::output_names() const {
  const Program& program = binding_.main_->shader().program();
  std::vector<std::string> names;
  for (std::string_view name : kResults[static_cast<size_t>(program.kind)])
    if (!name.empty()) names.emplace_back(name);
  auto add_stored = [&](const Instance* shader) {
    if (!shader) return;
    for (const Slot& slot : shader->shader().program().slots)
      if (slot.stored && !slot.parameter && std::find(names.begin(), names.end(), slot.name) == names.end())
        names.push_back(slot.name);
  };
  add_stored(binding_.main_.get());
  for (const Instance* shader : {binding_.set_.displacement, binding_.set_.surface, binding_.set_.atmosphere})
    add_stored(shader);
  return names;
}

RunResult Worker::result() const {
  RunResult result;
  const size_t points = grid_.points();
  StringPool& strings = binding_.machine_.strings();
  for (const std::string& name : output_names())
    if (const Planes& planes = grid_.variable(find_global(name)); planes.data)
      result.outputs.push_back(read(name, planes, points, strings));
  for (const Param& p : binding_.main_->shader().program().params) {
    if (!p.output) continue;
    if (const Planes* planes = context_.output(*binding_.main_, p.name); planes && planes->data)
      result.outputs.push_back(read(p.name, *planes, points, strings));
  }
  result.printed = services_.printed();
  result.messages = binding_.messages();
  result.warnings = binding_.main_warnings_;
  return result;
}

bool run_once(const Setup& setup, const Prepared& prepared, ShaderLibrary& library, const RunConfig& config,
              RunResult& result, RunError& error) {
  std::unique_ptr<Binding> binding = Binding::make(setup, prepared, library, config, error);
  if (!binding) return false;
  Worker worker(*binding);
  worker.shade();
  result = worker.result();
  return true;
}

} // namespace slvm::sltest
