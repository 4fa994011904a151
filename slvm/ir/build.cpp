// Making IR.
#include "slvm/ir/build.h"

#include <algorithm>
#include <cassert>

namespace slvm::ir {

std::string_view op_name(Op op) {
  constexpr std::string_view kNames[kOpCount] = {
      "constant",  "slot",       "store", "call",     "retype", "array",       "arrayclear",
      "arrayload", "arraystore", "if",    "loop",     "block",  "illuminance", "illuminate",
      "solar",     "yield",      "break", "continue", "gather"};
  return kNames[static_cast<int>(op)];
}

namespace {

// The strongest effect inside a region. Breaks and continues of loops entered on the way (fewer than `depth`)
// stay inside and do not count.
Effect region_effect(const Module& m, const Region& region, uint32_t depth) {
  Effect worst = Effect::kNone;
  for (InstId id : region.body) {
    const Inst& inst = m.insts[id];
    if (inst.op == Op::kYield) continue;
    if ((inst.op == Op::kBreak || inst.op == Op::kContinue) && inst.index < depth) continue;
    if (inst.regions.empty()) {
      worst = std::max(worst, effect_of(m, inst));
      continue;
    }
    if (inst.op == Op::kIlluminance || inst.op == Op::kGather) worst = std::max(worst, Effect::kReads);
    if (inst.op == Op::kIlluminate || inst.op == Op::kSolar)
      return Effect::kWrites; // what lights emit counts
    for (const Region& nested : inst.regions)
      worst = std::max(worst, region_effect(m, nested, depth + is_loop(inst.op)));
  }
  return worst;
}

} // namespace

Effect effect_of(const Module& m, const Inst& inst) {
  switch (inst.op) {
  case Op::kStore:
  case Op::kArrayClear:
  case Op::kArrayStore:
  case Op::kYield:
  case Op::kBreak:
  case Op::kContinue:
  case Op::kIlluminate:
  case Op::kSolar: return Effect::kWrites;
  case Op::kArrayLoad: return Effect::kReads;
  case Op::kSlot: return m.slots[inst.index].stored ? Effect::kReads : Effect::kNone;
  case Op::kCall: {
    const ShadeopInfo& info = m.called(inst);
    bool stores_array = std::any_of(inst.results.begin(), inst.results.end(),
                                    [&](ValueId r) { return m.values[r].array >= 0; });
    if (info.flags & kEffect || info.kind == ShadeopKind::kPending || stores_array) return Effect::kWrites;
    bool reads_array =
        std::any_of(inst.args.begin(), inst.args.end(), [&](ValueId a) { return m.values[a].array >= 0; });
    return info.flags & (kReadsState | kLights) || reads_array ? Effect::kReads : Effect::kNone;
  }
  case Op::kIf:
  case Op::kLoop:
  case Op::kBlock:
  case Op::kIlluminance:
  case Op::kGather: {
    const bool asks = inst.op == Op::kIlluminance || inst.op == Op::kGather;
    Effect worst = asks ? Effect::kReads : Effect::kNone;
    for (const Region& r : inst.regions)
      worst = std::max(worst, region_effect(m, r, is_loop(inst.op)));
    return worst;
  }
  case Op::kConstant:
  case Op::kRetype:
  case Op::kArray: return Effect::kNone;
  }
  return Effect::kWrites;
}

bool Builder::terminated() const {
  return !region_->body.empty() && is_terminator(m_.insts[region_->body.back()].op);
}

ValueId Builder::new_value(Type t) {
  m_.values.push_back({t, -1, false});
  return static_cast<ValueId>(m_.values.size() - 1);
}

InstId Builder::add(Inst inst) {
  assert(region_ && !terminated());
  inst.where = where;
  m_.insts.push_back(std::move(inst));
  auto id = static_cast<InstId>(m_.insts.size() - 1);
  region_->body.push_back(id);
  return id;
}

InstId Builder::terminator(Op op, uint32_t level, std::vector<ValueId> args) {
  return add({op, level, {}, std::move(args), {}, {}});
}

ValueId Builder::constant(Constant c) {
  auto it = std::find(m_.constants.begin(), m_.constants.end(), c);
  auto index = static_cast<uint32_t>(it - m_.constants.begin());
  ValueId v = new_value(c.type);
  if (it == m_.constants.end()) m_.constants.push_back(std::move(c));
  add({Op::kConstant, index, {}, {}, {v}, {}});
  return v;
}

ValueId Builder::slot(uint32_t slot) {
  ValueId v = new_value(m_.slots[slot].type);
  add({Op::kSlot, slot, {}, {}, {v}, {}});
  return v;
}

void Builder::store(uint32_t slot, ValueId value) {
  m_.slots[slot].stored = true;
  add({Op::kStore, slot, {}, {value}, {}, {}});
}

std::vector<ValueId> Builder::call(ShadeopId id, std::span<const ValueId> args,
                                   std::span<const Type> result_types) {
  std::vector<ValueId> results;
  for (Type t : result_types)
    results.push_back(new_value(t));
  add({Op::kCall, id, {}, {args.begin(), args.end()}, results, {}});
  return results;
}

ValueId Builder::call(std::string_view name, std::string_view signature,
                      std::initializer_list<ValueId> args) {
  int id = find_shadeop(name, signature);
  assert(id >= 0);
  Type result = shadeop(static_cast<ShadeopId>(id)).signature.result;
  return call(static_cast<ShadeopId>(id), std::span(args.begin(), args.size()), std::span(&result, 1))[0];
}

ValueId Builder::retype(Type t, ValueId value) {
  if (m_.type(value) == t) return value;
  assert(components(t) == components(m_.type(value)));
  ValueId v = new_value(t);
  add({Op::kRetype, 0, {}, {value}, {v}, {}});
  return v;
}

ValueId Builder::array(uint32_t array) {
  ValueId v = new_value(m_.arrays[array].type);
  m_.values[v].array = static_cast<int32_t>(array);
  add({Op::kArray, array, {}, {}, {v}, {}});
  return v;
}

void Builder::array_clear(uint32_t array) {
  add({Op::kArrayClear, array, {}, {}, {}, {}});
}

ValueId Builder::array_load(uint32_t array, ValueId subscript) {
  ValueId v = new_value(m_.arrays[array].type);
  add({Op::kArrayLoad, array, {}, {subscript}, {v}, {}});
  return v;
}

void Builder::array_store(uint32_t array, ValueId subscript, ValueId value) {
  add({Op::kArrayStore, array, {}, {subscript, value}, {}, {}});
}

InstId Builder::region_inst(Op op, uint32_t index, std::vector<ValueId> args, std::vector<Region> regions,
                            std::span<const Type> result_types) {
  std::vector<ValueId> results;
  for (Type t : result_types)
    results.push_back(new_value(t));
  return add({op, index, {}, std::move(args), std::move(results), std::move(regions)});
}

uint32_t Builder::add_array(Type t, uint32_t elements, int32_t slot) {
  m_.arrays.push_back({t, elements, slot, false});
  return static_cast<uint32_t>(m_.arrays.size() - 1);
}

void replace_uses(Module& m, Region& region, const std::vector<ValueId>& replacement) {
  auto resolve = [&](ValueId v) {
    while (v < replacement.size() && replacement[v] != kNoValue && replacement[v] != v)
      v = replacement[v];
    return v;
  };
  for_each_inst(m, region, [&](InstId id) {
    for (ValueId& arg : m.insts[id].args)
      arg = resolve(arg);
  });
}

} // namespace slvm::ir
