// Loading, binding, and the table of run-time messages.
#include "slvm/machine.h"

#include "slvm/evaluator.h"
#include "slvm/exec/bind.h"
#include "slvm/exec/bound.h"
#include "slvm/exec/grid_ops.h"
#include "slvm/exec/neighbours.h"
#include "slvm/exec/plugin_host.h"
#include "slvm/format/decode.h"
#include "slvm/format/slo.h"
#include "slvm/kernels/table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <fmt/format.h>

namespace slvm {

Instance::Instance() = default;
Instance::~Instance() = default;

Machine::Machine(MachineOptions options) : options_(std::move(options)) {
  const size_t vectors = std::max<size_t>((options_.strip_points + kMaxLanes - 1) / kMaxLanes, 1);
  options_.strip_points = static_cast<uint32_t>(vectors * kMaxLanes);
  kernels_ = options_.target.empty() ? nullptr : find_kernel_table(options_.target);
  if (!kernels_) kernels_ = &kernel_table();
  evaluator_ = make_kernel_evaluator(options_.target);
  if (!evaluator_) evaluator_ = make_kernel_evaluator();
  plugins_ = std::make_unique<PluginHost>(*this, options_.plugin_folders);
}

Machine::~Machine() = default;

std::string Machine::end_plugins() const {
  return plugins_->end_frame();
}

Result<std::shared_ptr<const Shader>> Machine::load(std::span<const std::byte> slo) const {
  Result<Program> program = read_slo(slo);
  if (!program) return Error{program.error()};
  auto shader = std::make_shared<Shader>();
  shader->program_ = std::move(*program);
  return std::shared_ptr<const Shader>(shader);
}

Result<std::shared_ptr<const Shader>> Machine::load_file(const std::string& path) const {
  Result<std::vector<std::byte>> bytes = read_file(path);
  if (!bytes) return Error{bytes.error()};
  auto shader = load(*bytes);
  return shader ? shader
                : Result<std::shared_ptr<const Shader>>(Error{fmt::format("{}: {}", path, shader.error())});
}

namespace {

// One plane of kMaxLanes equal floats for each number.
void splat(float* planes, std::span<const float> numbers) {
  for (size_t i = 0; i < numbers.size(); ++i)
    std::fill_n(planes + i * kMaxLanes, kMaxLanes, numbers[i]);
}

void bind_constants(Instance::Bound& bound, const Program& program, StringPool& strings) {
  std::vector<float> numbers = program.constants;
  for (auto [plane, text] : program.string_constants)
    numbers[plane] = std::bit_cast<float>(strings.intern(program.strings[text]));
  splat(bound.constants.reserve(std::max<size_t>(numbers.size(), 1) * kMaxLanes), numbers);
}

void bind_params(Instance::Bound& bound, const Program& program, const BoundValues& values,
                 StringPool& strings) {
  size_t planes = 0;
  for (const auto& v : values)
    if (v) planes += v->numbers.size() + v->strings.size();
  float* next = bound.params.reserve(std::max<size_t>(planes, 1) * kMaxLanes);
  bound.param_planes.assign(program.slots.size(), {});
  for (size_t i = 0; i < program.params.size(); ++i) {
    const Param& p = program.params[i];
    if (!values[i]) {
      if (p.init >= 0)
        bound.defaults.emplace_back(static_cast<uint32_t>(p.init), static_cast<uint32_t>(p.slot));
      continue;
    }
    std::vector<float> numbers = values[i]->numbers;
    for (const std::string& s : values[i]->strings)
      numbers.push_back(std::bit_cast<float>(strings.intern(s)));
    splat(next, numbers);
    if (p.slot >= 0)
      bound.param_planes[static_cast<size_t>(p.slot)] = {next, kMaxLanes, 0, p.type, p.elements};
    next += numbers.size() * kMaxLanes;
  }
}

void bind_variables(Instance::Bound& bound, const Program& program) {
  std::fill(std::begin(bound.slot_of), std::end(bound.slot_of), -1);
  for (size_t i = 0; i < program.slots.size(); ++i) {
    Global g = program.slots[i].parameter ? Global::kCount : find_global(program.slots[i].name);
    bound.globals.push_back(g);
    if (g != Global::kCount) bound.slot_of[static_cast<size_t>(g)] = static_cast<int32_t>(i);
  }
}

bool moves_with_strips(const Program& program, uint32_t word) {
  Space space = operand_space(word);
  if (space == Space::kSlot) return program.slots[operand_index(word)].varying;
  return space == Space::kGrid || space == Space::kArray;
}

void find_strip_operands(Instance::Bound& bound, const Program& program) {
  bool in_strip = false;
  for (uint32_t at = 0; at < program.code.size(); at += 1 + instruction_words(program.code[at])) {
    uint16_t opcode = instruction_opcode(program.code[at]);
    bool call = opcode >= kFirstShadeop;
    if (!call && static_cast<Opcode>(opcode) == Opcode::k_strip) in_strip = true;
    if (!call && static_cast<Opcode>(opcode) == Opcode::k_endstrip) in_strip = false;
    if (!in_strip) continue;
    std::string_view kinds = call ? std::string_view() : opcode_info(static_cast<Opcode>(opcode)).operands;
    for (uint32_t i = 0; i < instruction_words(program.code[at]); ++i)
      if (call || std::string_view("dsba").find(kinds[i]) != std::string_view::npos) {
        bool moving = moves_with_strips(program, program.code[at + 1 + i]);
        (moving ? bound.moving_operands : bound.fixed_operands).push_back(at + 1 + i);
      }
  }
}

// Facts of the code that a run asks for, and the functions it calls. The error names what this build cannot
// serve.
std::string bind_code(Instance::Bound& bound, const Program& program, const KernelTable& kernels,
                      PluginHost& plugins, bool zero_for_unserved) {
  std::vector<bool> called(program.imports.size());
  size_t emitters = 0;
  bool loops = false;
  for (uint32_t at = 0; at < program.code.size(); at += 1 + instruction_words(program.code[at])) {
    uint16_t opcode = instruction_opcode(program.code[at]);
    if (opcode >= kFirstShadeop) {
      called[opcode - kFirstShadeop] = true;
      bound.most_operands = std::max<size_t>(bound.most_operands, instruction_words(program.code[at]));
    }
    auto op = static_cast<Opcode>(opcode);
    emitters += op == Opcode::k_illuminate || op == Opcode::k_solar;
    loops |= op == Opcode::k_loop; // a block may then run several times
  }
  bound.emits = emitters > 0;
  bound.emits_once = emitters == 1 && !loops;
  for (size_t i = 0; i < program.imports.size(); ++i) {
    ShadeopId id = program.imports[i];
    const ShadeopInfo& info = program.plugins.info(id);
    if (const PluginShadeop* function = program.plugins.find(id)) {
      bound.imports.emplace_back();
      if (!called[i]) continue;
      auto hosted = plugins.bind(*function);
      if (!hosted)
        return fmt::format("{} \"{}\": {}", shader_kind_name(program.kind), program.name, hosted.error());
      bound.imports.back().plugin = *hosted;
      continue;
    }
    bound.imports.push_back({kernels[id], grid_op(id), nullptr});
    bound.reads_messages |= info.name == "surface" || info.name == "displacement" ||
                            info.name == "atmosphere" || info.name == "incident" || info.name == "opposite";
    if (called[i] && info.kind == ShadeopKind::kPending && zero_for_unserved)
      bound.imports.back().grid_op = grid_ops::unserved;
    else if (called[i] && info.kind == ShadeopKind::kPending)
      return fmt::format("{} \"{}\" calls '{}', which this build cannot serve",
                         shader_kind_name(program.kind), program.name, info.name);
  }
  return {};
}

std::vector<std::string> split_categories(const std::string& list) {
  std::vector<std::string> out;
  for (size_t at = 0; at < list.size();) {
    size_t end = std::min(list.find(',', at), list.size());
    size_t first = list.find_first_not_of(" \t", at), last = list.find_last_not_of(" \t", end - 1);
    if (first < end && last != list.npos && last >= first)
      out.push_back(list.substr(first, last + 1 - first));
    at = end + 1;
  }
  return out;
}

} // namespace

/// What an instance is made of.
struct Machine::Making {
  std::shared_ptr<const Shader> shader;
  std::span<const ParamValue> given;
  const Matrix4& shader_to_current;
  std::span<const std::string> may_vary;
  bool fold = true;
  const std::vector<std::string>* outputs = nullptr; ///< only these are wanted; null: all
  std::shared_ptr<const LightEmitter> emitter = nullptr;
};

Result<std::unique_ptr<Instance>> Machine::instantiate(std::shared_ptr<const Shader> shader,
                                                       std::span<const ParamValue> given,
                                                       const InstanceOptions& options) const {
  return make({std::move(shader), given, options.shader_to_current, options.may_vary, options_.specialise,
               nullptr, options.emitter});
}

Result<std::unique_ptr<Instance>> Machine::unspecialised(const Instance& light) const {
  return make(
      {light.shader_, light.bound().given, light.shader_to_current_, {}, false, nullptr, light.emitter_});
}

std::unique_ptr<Instance> Machine::narrowed(const Instance& surface,
                                            std::span<const std::string> outputs) const {
  const std::vector<std::string> wanted(outputs.begin(), outputs.end());
  auto made = make({surface.shader_, surface.bound().given, surface.shader_to_current_,
                    surface.bound().may_vary, options_.specialise, &wanted});
  return made && (*made)->specialised_ ? std::move(*made) : nullptr;
}

Result<std::unique_ptr<Instance>> Machine::make(const Making& making) const {
  std::unique_ptr<Instance> instance(new Instance);
  instance->id_ = ++instances_;
  instance->shader_ = making.shader;
  instance->shader_to_current_ = making.shader_to_current;
  instance->emitter_ = making.emitter;
  invert(making.shader_to_current, instance->current_to_shader_); // singular: all zeros
  const Program& all = instance->shader_->program();
  Result<BoundValues> values = bind_values(all, making.given, making.shader_to_current);
  if (!values) return Error{values.error()};
  if (making.fold && making.outputs)
    instance->specialised_ = narrow(all, *values, making.may_vary, *making.outputs, *evaluator_);
  else if (making.fold)
    instance->specialised_ = specialise(all, *values, making.may_vary, *evaluator_);
  const Program& program = instance->program();
  for (size_t i = 0; i < program.params.size(); ++i)
    if (program.params[i].name == "__category" && (*values)[i] && !(*values)[i]->strings.empty())
      instance->categories_ = split_categories((*values)[i]->strings[0]);
  instance->bound_ = std::make_unique<Instance::Bound>();
  Instance::Bound& bound = *instance->bound_;
  const ShaderKind kind = instance->shader().kind();
  if (kind == ShaderKind::kLight || kind == ShaderKind::kSurface) {
    bound.given.assign(making.given.begin(), making.given.end());
    bound.may_vary.assign(making.may_vary.begin(), making.may_vary.end());
  }
  if (std::string error = bind_code(bound, program, *kernels_, *plugins_, options_.zero_for_unserved);
      !error.empty())
    return Error{error};
  NeighbourUse use = find_neighbour_use(program);
  bound.neighbours_end = use.end;
  instance->reads_beside_ = std::move(use.reads);
  bind_constants(bound, program, strings_);
  bind_params(bound, program, *values, strings_);
  bind_variables(bound, program);
  find_strip_operands(bound, program);
  return instance;
}

void Machine::report(const RuntimeMessage& message) const {
  std::unique_lock lock(messages_mutex_);
  for (RuntimeMessage& known : messages_)
    if (known.line == message.line && known.file == message.file && known.shader == message.shader &&
        known.severity == message.severity && known.text == message.text) {
      known.points += message.points;
      known.total += message.total;
      known.times += message.times;
      return;
    }
  if (messages_.size() >= kMaxMessages) return;
  messages_.push_back(message);
  lock.unlock(); // whoever is told may ask for all messages
  if (options_.on_message) options_.on_message(message);
}

std::vector<RuntimeMessage> Machine::messages() const {
  std::lock_guard lock(messages_mutex_);
  std::vector<RuntimeMessage> out = messages_;
  std::sort(out.begin(), out.end(), [](const RuntimeMessage& a, const RuntimeMessage& b) {
    return std::tie(a.file, a.line, a.shader, a.text) < std::tie(b.file, b.line, b.shader, b.text);
  });
  return out;
}

} // namespace slvm
