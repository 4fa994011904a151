// What is read off finished code: facts for introspection, defaults of parameters.
#include "slc/lower/lower.h"

#include <algorithm>
#include <set>

namespace slc {

namespace ir = slvm::ir;

namespace {

// The constant a value is, or null.
const ir::Constant* constant_of(const ir::Module& m, const ir::Region& r, ir::ValueId v) {
  for (ir::InstId id : r.body) {
    const ir::Inst& inst = m.insts[id];
    if (inst.op == ir::Op::kConstant && inst.results[0] == v) return &m.constants[inst.index];
  }
  return nullptr;
}

// True when the region yields nothing but constants, which are then stored to `out`.
bool constant_yield(const ir::Module& m, const ir::Region& r, Type type, uint32_t elements,
                    slvm::Value& out) {
  const ir::Inst& yield = m.insts[r.body.back()];
  slvm::Value v{type, elements, {}, {}};
  for (ir::ValueId arg : yield.args) {
    const ir::Constant* c = constant_of(m, r, arg);
    if (!c) return false;
    if (type == Type::kString)
      v.strings.push_back(c->text);
    else
      v.numbers.insert(v.numbers.end(), c->numbers.begin(), c->numbers.end());
  }
  out = std::move(v);
  return true;
}

} // namespace

void settle_defaults(ir::Module& m) {
  std::vector<ir::Region> kept;
  for (slvm::Param& p : m.params) {
    const ir::Region& init = m.inits[static_cast<size_t>(p.init)];
    if (!p.default_space
             .empty()) { // computed from a value in a space: lowering noted where the plain value is
      const ir::Region& plain = m.inits[p.default_value.elements];
      p.default_known = constant_yield(m, plain, p.type, p.elements, p.default_value);
      if (!p.default_known) p.default_value = {p.type, p.elements, {}, {}};
    } else {
      p.default_value = {p.type, p.elements, {}, {}};
      p.default_known = constant_yield(m, init, p.type, p.elements, p.default_value);
      if (p.default_known) {
        if (p.type == Type::kColor)
          p.default_space = "rgb";
        else if (slvm::is_geometric(p.type) || p.type == Type::kMatrix)
          p.default_space = "current";
        p.init = -1;
        continue;
      }
    }
    auto index = static_cast<int32_t>(kept.size());
    kept.push_back(std::move(m.inits[static_cast<size_t>(p.init)]));
    p.init = index;
  }
  m.inits = std::move(kept);
}

slvm::Facts collect_facts(const ir::Module& m) {
  slvm::Facts facts;
  std::set<std::string> messages, textures, shadeops;
  std::vector<const ir::Constant*> constants(m.values.size());
  auto visit = [&](ir::InstId id) {
    const ir::Inst& inst = m.insts[id];
    if (inst.op == ir::Op::kConstant) constants[inst.results[0]] = &m.constants[inst.index];
    if (inst.op == ir::Op::kIlluminance) facts.lights = true;
    if (inst.op != ir::Op::kCall) return;
    const slvm::ShadeopInfo& info = slvm::shadeop(static_cast<ShadeopId>(inst.index));
    facts.derivatives |= (info.flags & slvm::kDerivative) != 0;
    facts.lights |= (info.flags & slvm::kLights) != 0;
    facts.rays |= (info.flags & slvm::kRays) != 0;
    facts.textures |= (info.flags & slvm::kTexture) != 0;
    if (!(info.flags & slvm::kInternal)) shadeops.insert(std::string(info.name));
    const ir::Constant* first = inst.args.empty() ? nullptr : constants[inst.args[0]];
    if (!first || first->type != Type::kString) return;
    if (info.flags & slvm::kTexture && !first->text.empty()) textures.insert(first->text);
    if (info.flags & slvm::kMessage) messages.insert(std::string(info.name) + ":" + first->text);
  };
  for (const ir::Region& r : m.inits)
    ir::for_each_inst(m, r, visit);
  ir::for_each_inst(m, m.body, visit);
  facts.messages_read.assign(messages.begin(), messages.end());
  facts.texture_names.assign(textures.begin(), textures.end());
  facts.shadeops.assign(shadeops.begin(), shadeops.end());
  return facts;
}

} // namespace slc
