// The checks of a module: tables first, then each root region in one walk that follows what is visible.
#include "slvm/ir/verify_ir.h"

#include "slvm/format/verify.h"

#include <algorithm>
#include <fmt/format.h>

namespace slvm::ir {
namespace {

struct Failure {
  std::string text;
};

/// Types with the same planes stand for each other: a retype costs nothing and may be left out.
bool same_planes(Type a, Type b) {
  return a == b || (is_triple(a) && is_triple(b));
}
bool is_storable(Type t) {
  return t != Type::kVoid && t != Type::kBool;
}

// ---- Slots, parameters, arrays, constants.

class TableChecks {
public:
  explicit TableChecks(const Module& m) : m_(m) {}

  void run() const {
    if (m_.insts.size() > kMaxInstructions) throw Failure{"more instructions than allowed"};
    for (const Slot& s : m_.slots)
      check_slot(s);
    for (const Param& p : m_.params)
      check_param(p);
    check_inits();
    uint64_t planes = 0;
    for (const Array& a : m_.arrays) {
      check_array(a);
      planes += uint64_t{a.elements} * static_cast<uint64_t>(components(a.type));
    }
    if (planes > kMaxUniformPlanes) throw Failure{"arrays take more memory than allowed"};
    for (const Constant& c : m_.constants) {
      auto numbers = static_cast<size_t>(c.type == Type::kString ? 0 : components(c.type));
      if (c.type == Type::kVoid || c.numbers.size() != numbers)
        throw Failure{"a constant does not fit its type"};
    }
  }

private:
  void check_slot(const Slot& s) const {
    if (!is_storable(s.type) || s.elements > kMaxUniformPlanes)
      throw Failure{fmt::format("variable '{}' has no proper type", s.name)};
    if (s.parameter) return;
    Global g = find_global(s.name);
    if (g == Global::kCount || global_info(g).type != s.type || s.elements != 0)
      throw Failure{fmt::format("'{}' is not a predefined variable of this type", s.name)};
  }

  void check_param(const Param& p) const {
    if (p.slot < -1 || p.slot >= static_cast<int32_t>(m_.slots.size()) || p.init < -1 ||
        p.init >= static_cast<int32_t>(m_.inits.size()) || (p.init >= 0 && p.slot < 0))
      throw Failure{fmt::format("parameter '{}' has no variable or no default", p.name)};
    if (!is_storable(p.type) || p.elements > kMaxUniformPlanes || !default_fits(p) ||
        (p.init < 0 && !p.default_known))
      throw Failure{fmt::format("the default of parameter '{}' does not fit its type", p.name)};
    if (p.slot < 0) return;
    const Slot& s = m_.slots[static_cast<size_t>(p.slot)];
    if (!s.parameter || s.type != p.type || s.elements != p.elements || s.varying != p.varying)
      throw Failure{fmt::format("parameter '{}' does not agree with its variable", p.name)};
    bool has_array =
        std::any_of(m_.arrays.begin(), m_.arrays.end(), [&](const Array& a) { return a.slot == p.slot; });
    if (p.init >= 0 && p.elements && !has_array)
      throw Failure{fmt::format("parameter '{}' has a default but no array", p.name)};
  }

  void check_inits() const {
    std::vector<bool> used(m_.inits.size());
    for (const Param& p : m_.params) {
      if (p.init < 0) continue;
      if (used[static_cast<size_t>(p.init)])
        throw Failure{fmt::format("parameter '{}' shares its default", p.name)};
      used[static_cast<size_t>(p.init)] = true;
    }
  }

  void check_array(const Array& a) const {
    bool ok = is_storable(a.type) && a.elements > 0 && a.elements <= kMaxUniformPlanes && a.slot >= -1 &&
              a.slot < static_cast<int32_t>(m_.slots.size());
    if (ok && a.slot >= 0) {
      const Slot& s = m_.slots[static_cast<size_t>(a.slot)];
      ok = s.type == a.type && s.elements == a.elements;
    }
    if (!ok) throw Failure{"an array out of bounds"};
  }

  const Module& m_;
};

// ---- Instructions.

class CodeChecks {
public:
  explicit CodeChecks(const Module& m)
      : m_(m), placed_(m.insts.size()), defined_(m.values.size()), visible_(m.values.size()) {}

  void run() {
    root(m_.body, nullptr);
    for (size_t i = 0; i < m_.inits.size(); ++i) {
      auto owner = std::find_if(m_.params.begin(), m_.params.end(),
                                [&](const Param& p) { return p.init == static_cast<int32_t>(i); });
      root(m_.inits[i], owner == m_.params.end() ? nullptr : &*owner);
    }
  }

private:
  [[noreturn]] void fail(std::string_view what) const {
    throw Failure{fmt::format("instruction {}: {}", at_, what)};
  }
  void require(bool ok, std::string_view what) const {
    if (!ok) fail(what);
  }

  void root(const Region& r, const Param* param) {
    param_ = param;
    is_body_ = &r == &m_.body;
    require(r.params.empty(), "a root region with parameters");
    region(r, nullptr);
  }

  // What the region defines is visible until its end.
  void region(const Region& r, const Inst* owner) {
    require(owners_.size() <= kMaxNesting, "regions nested too deeply");
    size_t first = scope_.size();
    owners_.push_back(owner);
    for (ValueId v : r.params)
      define(v);
    require(!r.body.empty(), "an empty region");
    for (size_t i = 0; i < r.body.size(); ++i) {
      at_ = r.body[i];
      require(at_ < m_.insts.size() && !placed_[at_], "an instruction that stands in no or several places");
      placed_[at_] = true;
      const Inst& inst = m_.insts[at_];
      bool last = i + 1 == r.body.size();
      require(is_terminator(inst.op) == last,
              "a region that does not end in a terminator, or goes on after it");
      instruction(inst);
    }
    owners_.pop_back();
    for (; scope_.size() > first; scope_.pop_back())
      visible_[scope_.back()] = false;
  }

  void define(ValueId v) {
    require(v < m_.values.size() && !defined_[v], "a value that is defined nowhere or twice");
    const ValueInfo& info = m_.values[v];
    require(info.type != Type::kVoid, "a value without type");
    require(info.array >= -1 && info.array < static_cast<int32_t>(m_.arrays.size()),
            "an array out of bounds");
    defined_[v] = visible_[v] = true;
    scope_.push_back(v);
  }

  void instruction(const Inst& inst) {
    require(inst.args.size() <= kMaxArgs && inst.results.size() <= kMaxArgs, "too many arguments or results");
    require(inst.where.file < std::max<size_t>(m_.files.size(), 1), "a position in no file");
    for (ValueId v : inst.args) {
      require(v < m_.values.size() && visible_[v], "a value that is not visible here");
      require(m_.values[v].array < 0 || names_shadeop(inst.op), "an array where a value must be");
    }
    InstId id = at_;
    check(inst);
    at_ = id; // nested regions moved it
    for (ValueId v : inst.results) {
      define(v);
      require(m_.values[v].array < 0 || inst.op == Op::kArray || inst.op == Op::kCall,
              "an array where a value must be");
      // The array a call stores to is named by its kArray: the result is not a value to go on with.
      if (inst.op == Op::kCall && m_.values[v].array >= 0) visible_[v] = false;
    }
  }

  void shape(const Inst& inst, size_t args, size_t results, size_t regions) const {
    require(inst.args.size() == args && inst.results.size() == results && inst.regions.size() == regions,
            "wrong number of arguments, results or regions");
  }
  void value_is(ValueId v, Type t) const {
    require(v < m_.values.size() && same_planes(m_.values[v].type, t), "a value of the wrong type");
  }
  void same_types(std::span<const ValueId> from, std::span<const ValueId> to) const {
    require(from.size() == to.size(), "wrong number of arguments, results or regions");
    for (size_t i = 0; i < from.size(); ++i) {
      require(to[i] < m_.values.size(), "a value that is defined nowhere or twice");
      value_is(from[i], m_.values[to[i]].type);
    }
  }

  void check(const Inst& inst) {
    switch (inst.op) {
    case Op::kConstant:
    case Op::kSlot:
    case Op::kStore:
    case Op::kRetype: return check_plain(inst);
    case Op::kArray:
    case Op::kArrayClear:
    case Op::kArrayLoad:
    case Op::kArrayStore: return check_array(inst);
    case Op::kCall: return check_call(inst);
    case Op::kIf: return check_if(inst);
    case Op::kLoop:
    case Op::kBlock: return check_loop(inst);
    case Op::kIlluminance:
    case Op::kIlluminate:
    case Op::kSolar: return check_lights(inst);
    case Op::kGather: return check_gather(inst);
    case Op::kYield: return check_yield(inst);
    case Op::kBreak:
    case Op::kContinue: return check_exit(inst);
    }
    fail("no such instruction");
  }

  void check_plain(const Inst& inst) const {
    switch (inst.op) {
    case Op::kConstant:
      shape(inst, 0, 1, 0);
      require(inst.index < m_.constants.size(), "a constant out of bounds");
      value_is(inst.results[0], m_.constants[inst.index].type);
      return;
    case Op::kRetype: {
      shape(inst, 1, 1, 0);
      value_is(inst.results[0], m_.type(inst.args[0]));
      return;
    }
    default: break;
    }
    bool store = inst.op == Op::kStore;
    shape(inst, store, !store, 0);
    require(inst.index < m_.slots.size() && m_.slots[inst.index].elements == 0, "a variable out of bounds");
    require(!store || m_.slots[inst.index].stored, "a store to a read-only variable");
    value_is(store ? inst.args[0] : inst.results[0], m_.slots[inst.index].type);
  }

  void check_array(const Inst& inst) const {
    require(inst.index < m_.arrays.size(), "an array out of bounds");
    const Array& a = m_.arrays[inst.index];
    bool load = inst.op == Op::kArrayLoad, store = inst.op == Op::kArrayStore;
    shape(inst, load ? 1 : store ? 2 : 0, load || inst.op == Op::kArray, 0);
    if (load || store) value_is(inst.args[0], Type::kFloat);
    if (load) value_is(inst.results[0], a.type);
    if (store) value_is(inst.args[1], a.type);
    if (inst.op == Op::kArray)
      require(inst.results[0] < m_.values.size() && m_.values[inst.results[0]].type == a.type &&
                  m_.values[inst.results[0]].array == static_cast<int32_t>(inst.index),
              "an array under another's name");
    if (store || inst.op == Op::kArrayClear) require_writable(inst.index);
  }
  void require_writable(uint32_t array) const {
    int32_t slot = m_.arrays[array].slot;
    require(slot < 0 || m_.slots[static_cast<size_t>(slot)].stored, "a store to a read-only array");
  }

  // ---- Calls: the arguments read and the results stored, against the signature.

  void check_call(const Inst& inst) const {
    require(inst.regions.empty(), "wrong number of arguments, results or regions");
    const ShadeopInfo& info = row_of(inst);
    const Signature& s = info.signature;
    auto does_not_fit = [&] { fail(fmt::format("operands do not fit '{}'", info.name)); };
    size_t result = 0;
    if (s.result != Type::kVoid) {
      if (inst.results.empty() || is_array(inst.results[0])) does_not_fit();
      value_is(inst.results[result++], s.result);
    }
    for (int i = 0; i < s.param_count; ++i) {
      const SignatureParam& p = s.param(i);
      if (!p.output) continue;
      if (result == inst.results.size() || !fits(inst.results[result], p)) does_not_fit();
      if (is_array(inst.results[result]))
        require_writable(static_cast<uint32_t>(m_.values[inst.results[result]].array));
      ++result;
    }
    if (info.flags & kTokenOut) // one for each pair, at most
      for (size_t pairs = inst.args.size() / 2; pairs > 0 && result < inst.results.size(); --pairs, ++result)
        if (is_array(inst.results[result])) does_not_fit();
    if (result != inst.results.size()) does_not_fit();
    check_read(inst, inst.args.size());
  }

  const ShadeopInfo& row_of(const Inst& inst) const {
    require(m_.plugins.knows(inst.index), "a call of no shadeop");
    const ShadeopInfo& info = m_.called(inst);
    require(info.kind != ShadeopKind::kRsl, "a call of a function that has no code of its own");
    return info;
  }

  /// The first `count` arguments are what the row reads. Pairs of gather may name arrays that are set.
  void check_read(const Inst& inst, size_t count) const {
    const ShadeopInfo& info = row_of(inst);
    const Signature& s = info.signature;
    auto does_not_fit = [&] { fail(fmt::format("operands do not fit '{}'", info.name)); };
    size_t arg = 0;
    for (int i = 0; i < s.param_count; ++i) {
      const SignatureParam& p = s.param(i);
      if (!p.input) continue;
      do {
        if (arg == count || !fits(inst.args[arg++], p)) does_not_fit();
      } while (p.variadic && arg < count);
    }
    while (!s.token_set.empty() && arg + 1 < count) {
      if (m_.type(inst.args[arg]) != Type::kString || is_array(inst.args[arg]) ||
          (is_array(inst.args[arg + 1]) && inst.op != Op::kGather))
        does_not_fit();
      arg += 2;
    }
    if (arg != count) does_not_fit();
  }
  bool is_array(ValueId v) const { return v < m_.values.size() && m_.values[v].array >= 0; }
  bool fits(ValueId v, const SignatureParam& p) const {
    if (v >= m_.values.size() || p.array != is_array(v)) return false;
    if (is_array(v)) { // only as what it is
      auto array = static_cast<size_t>(m_.values[v].array);
      if (array >= m_.arrays.size() || m_.arrays[array].type != m_.values[v].type) return false;
      if (p.elements && p.elements != m_.arrays[array].elements) return false;
    }
    return p.any ? m_.type(v) != Type::kVoid : same_planes(m_.type(v), p.type);
  }

  // ---- Regions.

  void check_if(const Inst& inst) {
    shape(inst, 1, inst.results.size(), 2);
    require(m_.type(inst.args[0]) == Type::kBool, "a condition that is not a bool");
    for (const Region& r : inst.regions) {
      require(r.params.empty(), "a branch with parameters");
      region(r, &inst);
    }
  }

  void carried(const Inst& inst) {
    require(inst.regions.size() == 1, "wrong number of arguments, results or regions");
    const Region& body = inst.regions[0];
    uint32_t fixed = fixed_args(inst);
    require(inst.args.size() >= fixed, "wrong number of arguments, results or regions");
    for (size_t i = fixed; i < inst.args.size(); ++i)
      require(!is_array(inst.args[i]), "an array where a value must be");
    same_types(std::span(inst.args).subspan(fixed), inst.results);
    same_types(inst.results, body.params);
    for (ValueId v : inst.results)
      require(m_.values[v].array < 0, "an array where a value must be");
    for (ValueId v : body.params)
      require(m_.values[v].array < 0, "an array where a value must be");
    region(body, &inst);
  }

  void check_loop(const Inst& inst) {
    if (inst.op == Op::kLoop) return carried(inst);
    shape(inst, 0, inst.results.size(), 1);
    require(inst.regions[0].params.empty(), "a block with parameters");
    region(inst.regions[0], &inst);
  }

  void check_lights(const Inst& inst) {
    bool loop = inst.op == Op::kIlluminance;
    require(is_body_ && loop != (m_.kind == ShaderKind::kLight),
            "a light statement in the wrong kind of shader");
    for (const Inst* owner : owners_)
      require(!owner || !is_light_statement(owner->op), "light statements do not nest");
    static constexpr Type kFixed[3][4] = {{Type::kString, Type::kPoint, Type::kVector, Type::kFloat},
                                          {Type::kPoint, Type::kVector, Type::kFloat},
                                          {Type::kVector, Type::kFloat}};
    uint32_t fixed = fixed_args(inst);
    require(inst.args.size() >= fixed && inst.regions.size() == 1,
            "wrong number of arguments, results or regions");
    for (uint32_t i = 0; i < fixed; ++i)
      value_is(inst.args[i], kFixed[4 - fixed][i]);
    require(inst.index <= 1, "an index out of bounds");
    if (loop) return carried(inst);
    for (Global g : {Global::kL, Global::kPs, Global::kNs})
      require(has_slot(g), "a light cone without L, Ps and Ns");
    same_types(std::span(inst.args).subspan(fixed), inst.results);
    require(inst.regions[0].params.empty(), "a light cone with parameters");
    region(inst.regions[0], &inst);
  }

  void check_gather(const Inst& inst) {
    const ShadeopInfo& info = row_of(inst);
    require(is_body_ && (info.name == "gather" || info.name == "traverse"),
            "a loop over the rays of no call");
    require(inst.args.size() >= inst.results.size(), "wrong number of arguments, results or regions");
    check_read(inst, fixed_args(inst));
    carried(inst);
  }

  bool has_slot(Global g) const {
    return std::any_of(m_.slots.begin(), m_.slots.end(),
                       [&](const Slot& s) { return !s.parameter && s.name == global_info(g).name; });
  }

  void check_yield(const Inst& inst) const {
    shape(inst, inst.args.size(), 0, 0);
    const Inst* owner = owners_.back();
    if (owner) {
      require(!is_loop(owner->op), "a yield in a loop");
      return same_types(inst.args, owner->results);
    }
    if (is_body_) require(inst.args.empty(), "the shader's body yields values");
    if (!param_) return;
    require(inst.args.size() == std::max(param_->elements, 1u), "a default with another number of elements");
    for (ValueId v : inst.args)
      value_is(v, param_->type);
  }

  void check_exit(const Inst& inst) const {
    shape(inst, inst.args.size(), 0, 0);
    uint32_t level = inst.index;
    const Inst* loop = nullptr;
    for (size_t i = owners_.size(); i-- > 0 && !loop;)
      if (owners_[i] && is_loop(owners_[i]->op) && level-- == 0) loop = owners_[i];
    require(loop, "an exit from more loops than there are");
    require(inst.op == Op::kBreak || loop->op != Op::kBlock, "the next round of no loop");
    same_types(inst.args, loop->results);
  }

  const Module& m_;
  std::vector<bool> placed_, defined_, visible_; // instructions; values; values
  std::vector<ValueId> scope_;                   // visible values in the order of definition
  std::vector<const Inst*> owners_;              // of the open regions; null for a root
  const Param* param_ = nullptr;                 // whose default the root computes
  bool is_body_ = false;
  InstId at_ = 0;
};

} // namespace

std::string verify_module(const Module& m) {
  try { // exceptions stay inside this function: the checks are many and nested
    TableChecks(m).run();
    CodeChecks(m).run();
  } catch (const Failure& failure) {
    return failure.text;
  }
  return "";
}

} // namespace slvm::ir
