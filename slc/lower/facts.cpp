// What is read off finished code: facts for introspection, defaults of parameters.
#include "slc/lower/lower.h"
#include "slc/lower/uses.h"

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

slvm::Facts collect_facts(const ir::Module& m, const std::vector<slvm::SourceCall>& calls) {
  const Uses uses = collect_uses(m, calls);
  slvm::Facts facts;
  auto named = [](const std::vector<Use>& list, bool with_function) {
    std::set<std::string> names;
    for (const Use& use : list)
      if (use.name.kind == Naming::kConstant && !use.name.text.empty())
        names.insert(with_function ? use.by + ":" + use.name.text : use.name.text);
    return std::vector<std::string>(names.begin(), names.end());
  };
  facts.derivatives = !uses.derivatives.empty();
  facts.lights = std::any_of(uses.lights.begin(), uses.lights.end(), [](const Use& use) {
    return use.by != "illuminate" && use.by != "solar"; // these make light
  });
  facts.textures = !uses.textures.empty();
  facts.rays = !uses.rays.empty();
  facts.messages_read = named(uses.messages, true);
  facts.texture_names = named(uses.textures, false);
  std::set<std::string> names, libraries;
  for (const CallUse& use : uses.calls) {
    names.insert(std::string(use.info().name));
    if (use.plugin) libraries.insert(use.plugin->name().library);
    for (const SourceRange& place : use.places)
      facts.calls.push_back({use.shadeop, place.file, place.line, place.column});
  }
  facts.shadeops.assign(names.begin(), names.end());
  facts.plugins.assign(libraries.begin(), libraries.end());
  return facts;
}

} // namespace slc
