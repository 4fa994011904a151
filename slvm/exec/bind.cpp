// Parameter values: checked against the shader, transformed to "current" space, folded into the code.
#include "slvm/exec/bind.h"

#include "slvm/format/verify.h"
#include "slvm/ir/emit.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/ir/serialise.h"
#include "slvm/support/diagnostics.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace slvm {
namespace {

std::string type_text(Type t, uint32_t elements) {
  return elements ? fmt::format("{}[{}]", type_name(t), elements) : std::string(type_name(t));
}

// Points, vectors, normals and matrices of a scene are in the shader's space.
Value to_current(Value v, Type type, const Matrix4& m) {
  auto each = [&](auto&& f) {
    for (size_t i = 0; i + 2 < v.numbers.size(); i += 3) {
      std::array<float, 3> x = f(std::array<float, 3>{v.numbers[i], v.numbers[i + 1], v.numbers[i + 2]});
      std::copy(x.begin(), x.end(), v.numbers.begin() + static_cast<std::ptrdiff_t>(i));
    }
  };
  if (type == Type::kPoint) each([&](auto p) { return transform_point(m, p); });
  if (type == Type::kVector) each([&](auto p) { return transform_vector(m, p); });
  if (type == Type::kNormal) each([&](auto p) { return transform_normal(m, p); });
  if (type == Type::kMatrix)
    for (size_t i = 0; i + 15 < v.numbers.size(); i += 16) {
      Matrix4 own;
      std::copy_n(v.numbers.begin() + static_cast<std::ptrdiff_t>(i), 16, own.m.begin());
      own = own * m;
      std::copy_n(own.m.begin(), 16, v.numbers.begin() + static_cast<std::ptrdiff_t>(i));
    }
  return v;
}

std::string check_type(const Param& p, const Value& v) {
  bool same = v.type == p.type || (is_geometric(v.type) && is_geometric(p.type));
  size_t numbers = p.type == Type::kString ? 0 : static_cast<size_t>(components(p.type)) * v.count();
  size_t strings = p.type == Type::kString ? v.count() : 0;
  if (same && v.elements == p.elements && v.numbers.size() == numbers && v.strings.size() == strings)
    return {};
  return fmt::format("parameter '{}' is a {}, not a {}", p.name, type_text(p.type, p.elements),
                     type_text(v.type, v.elements));
}

std::string unknown_parameter(const Program& program, const std::string& name) {
  std::vector<std::string_view> names;
  for (const Param& p : program.params)
    names.push_back(p.name);
  std::string text =
      fmt::format("{} \"{}\" has no parameter '{}'", shader_kind_name(program.kind), program.name, name);
  if (std::string_view near = nearest_name(name, names); !near.empty())
    text += fmt::format("; did you mean '{}'?", near);
  return text;
}

} // namespace

Result<BoundValues> bind_values(const Program& program, std::span<const ParamValue> given,
                                const Matrix4& shader_to_current) {
  BoundValues values(program.params.size());
  for (const ParamValue& g : given) {
    auto it = std::find_if(program.params.begin(), program.params.end(),
                           [&](const Param& p) { return p.name == g.name; });
    if (it == program.params.end()) return Error{unknown_parameter(program, g.name)};
    if (std::string error = check_type(*it, g.value); !error.empty()) return Error{error};
    Value v = to_current(g.value, it->type, shader_to_current);
    v.type = it->type;
    values[static_cast<size_t>(it - program.params.begin())] = std::make_unique<Value>(std::move(v));
  }
  for (size_t i = 0; i < values.size(); ++i) {
    const Param& p = program.params[i];
    if (values[i] || !p.default_known) continue;
    bool in_shader_space = p.default_space == "shader" && p.type != Type::kColor;
    if (p.init >= 0 && !in_shader_space) continue; // needs other spaces: computed on each grid
    values[i] = std::make_unique<Value>(
        in_shader_space ? to_current(p.default_value, p.type, shader_to_current) : p.default_value);
  }
  return values;
}

namespace {

/// A file may hold the IR of another shader: values bound by the program's parameters must fit the module's.
bool belongs_to(const ir::Module& m, const Program& program) {
  auto same = [](const Param& a, const Param& b) {
    return a.name == b.name && a.type == b.type && a.elements == b.elements && a.varying == b.varying;
  };
  return m.kind == program.kind &&
         std::equal(m.params.begin(), m.params.end(), program.params.begin(), program.params.end(), same);
}

/// The module of a program with these values in place of what reads the parameters. Empty: none is carried.
std::optional<ir::Module> module_of(const Program& program, const BoundValues& values,
                                    std::span<const std::string> may_vary) {
  if (program.ir.empty()) return std::nullopt;
  Result<ir::Module> module = ir::deserialise(program.ir);
  if (!module || !belongs_to(*module, program)) return std::nullopt;
  std::map<uint32_t, uint32_t> constant_of; // slot to index of its constant
  for (size_t i = 0; i < values.size() && i < module->params.size(); ++i) {
    const Param& p = module->params[i];
    bool vary = p.varying || std::find(may_vary.begin(), may_vary.end(), p.name) != may_vary.end();
    if (!values[i] || p.elements || p.slot < 0 || vary || module->slots[static_cast<size_t>(p.slot)].stored)
      continue;
    constant_of[static_cast<uint32_t>(p.slot)] = static_cast<uint32_t>(module->constants.size());
    module->constants.push_back(
        {p.type, values[i]->numbers, values[i]->strings.empty() ? "" : values[i]->strings[0]});
  }
  ir::for_each_root(*module, [&](ir::Region& r) {
    ir::for_each_inst(*module, r, [&](ir::InstId id) {
      ir::Inst& inst = module->insts[id];
      if (inst.op != ir::Op::kSlot) return;
      if (auto it = constant_of.find(inst.index); it != constant_of.end()) {
        inst.op = ir::Op::kConstant;
        inst.index = it->second;
      }
    });
  });
  return std::move(*module);
}

std::unique_ptr<const Program> compiled(const Program& program, ir::Module& module,
                                        const ir::ConstantEvaluator& evaluator) {
  ir::optimise(module, 2, &evaluator);
  if (ir::fuse_products(module)) ir::infer_detail(module);
  if (program.kind == ShaderKind::kSurface) ir::derivatives_first(module);
  auto out = std::make_unique<Program>(program);
  out->ir.clear();
  ir::emit(module, *out);
  if (!verify_program(*out).empty()) return nullptr; // sound IR can still ask for what no code may do
  return out;
}

/// Takes out stores to `slots`. False: there are none.
bool drop_stores(ir::Module& m, ir::Region& region, const std::vector<bool>& slots) {
  bool dropped = std::erase_if(region.body, [&](ir::InstId id) {
                   return m.insts[id].op == ir::Op::kStore && slots[m.insts[id].index];
                 }) > 0;
  for (ir::InstId id : region.body)
    for (ir::Region& nested : m.insts[id].regions)
      dropped |= drop_stores(m, nested, slots);
  return dropped;
}

/// Whether others than the shader itself may read its variables while it runs.
bool is_looked_at(const ir::Module& m) {
  bool looked_at = false;
  ir::for_each_inst(m, m.body, [&](ir::InstId id) {
    const ir::Inst& inst = m.insts[id];
    looked_at |= inst.op == ir::Op::kIlluminance ||
                 (inst.op == ir::Op::kCall && m.plugins.find(static_cast<ShadeopId>(inst.index)));
  });
  return looked_at;
}

} // namespace

std::unique_ptr<const Program> specialise(const Program& program, const BoundValues& values,
                                          std::span<const std::string> may_vary,
                                          const ir::ConstantEvaluator& evaluator) {
  auto module = module_of(program, values, may_vary);
  return module ? compiled(program, *module, evaluator) : nullptr;
}

std::unique_ptr<const Program> narrow(const Program& program, const BoundValues& values,
                                      std::span<const std::string> may_vary,
                                      std::span<const std::string> outputs,
                                      const ir::ConstantEvaluator& evaluator) {
  auto module = program.kind == ShaderKind::kSurface ? module_of(program, values, may_vary) : std::nullopt;
  if (!module) return nullptr;
  std::vector<bool> unwanted(module->slots.size());
  for (size_t i = 0; i < unwanted.size(); ++i) {
    const Slot& slot = module->slots[i];
    unwanted[i] = (slot.parameter || slot.name == "Ci" || slot.name == "Oi") &&
                  std::find(outputs.begin(), outputs.end(), slot.name) == outputs.end();
  }
  if (!drop_stores(*module, module->body, unwanted)) return nullptr;
  auto out = compiled(program, *module, evaluator);
  return out && !is_looked_at(*module) ? std::move(out) : nullptr;
}

} // namespace slvm
