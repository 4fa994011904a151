// Constant folding: calls whose arguments are constants, identities with one constant, ifs whose condition is
// one.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

namespace slvm::ir {
namespace {

class Folder {
public:
  Folder(Module& m, const ConstantEvaluator* evaluator) : m_(m), evaluator_(evaluator) {}

  bool run() {
    constant_of_.assign(m_.values.size(), -1);
    replacement_.assign(m_.values.size(), kNoValue);
    for_each_root(m_, [&](Region& r) { fold_region(r); });
    if (changed_) for_each_root(m_, [&](Region& r) { replace_uses(m_, r, replacement_); });
    return changed_;
  }

private:
  const Constant* constant(ValueId v) const {
    while (v < replacement_.size() && replacement_[v] != kNoValue)
      v = replacement_[v];
    return v < constant_of_.size() && constant_of_[v] >= 0
               ? &m_.constants[static_cast<size_t>(constant_of_[v])]
               : nullptr;
  }

  // Of a bool: -1 unknown, else 0 or 1.
  int truth(ValueId v) const {
    const Constant* c = constant(v);
    uint32_t bits = 0;
    if (!c) return -1;
    std::memcpy(&bits, c->numbers.data(), sizeof bits);
    return bits ? 1 : 0;
  }

  bool is_number(ValueId v, float x) const {
    const Constant* c = constant(v);
    return c && c->type != Type::kString && c->type != Type::kBool &&
           std::all_of(c->numbers.begin(), c->numbers.end(), [&](float n) { return n == x; });
  }

  uint32_t constant_index(Constant c) {
    auto same = [&](const Constant& other) { // bitwise: -0 is not 0, and a NaN equals itself
      return other.type == c.type && other.text == c.text &&
             std::equal(
                 other.numbers.begin(), other.numbers.end(), c.numbers.begin(), c.numbers.end(),
                 [](float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); });
    };
    auto it = std::find_if(m_.constants.begin(), m_.constants.end(), same);
    if (it == m_.constants.end()) it = m_.constants.insert(it, std::move(c));
    return static_cast<uint32_t>(it - m_.constants.begin());
  }

  void become_constant(InstId id, Constant c) {
    uint32_t index = constant_index(std::move(c));
    Inst& inst = m_.insts[id];
    inst.op = Op::kConstant;
    inst.index = index;
    inst.args.clear();
    constant_of_[inst.results[0]] = static_cast<int32_t>(index);
    changed_ = true;
  }

  void become_value(InstId id, ValueId v) {
    replacement_[m_.insts[id].results[0]] = v;
    changed_ = true;
  }

  // x*1, 1*x, x/1, x-0: exact for every x. (x+0 is not, for x = -0, nor x*0, for infinities.)
  bool fold_identity(InstId id, std::string_view name) {
    const Inst& inst = m_.insts[id];
    if (inst.args.size() != 2 || inst.results.size() != 1) return false;
    Type t = m_.type(inst.results[0]);
    ValueId a = inst.args[0], b = inst.args[1];
    if (t == Type::kMatrix) return false;
    bool right = (name == "operator*" || name == "operator/") ? is_number(b, 1)
                                                              : name == "operator-" && is_number(b, 0);
    if (right && m_.type(a) == t) return become_value(id, a), true;
    if (name == "operator*" && is_number(a, 1) && m_.type(b) == t) return become_value(id, b), true;
    return false;
  }

  // A relation with a constant side, or a selection by a constant.
  bool fold_logic(InstId id, std::string_view name) {
    const Inst& inst = m_.insts[id];
    if (name == "operator?:" && truth(inst.args[0]) >= 0) {
      become_value(id, inst.args[truth(inst.args[0]) ? 1 : 2]);
      return true;
    }
    if (name != "operator&&" && name != "operator||") return false;
    int neutral = name == "operator&&";
    for (size_t i = 0; i < 2; ++i) {
      int t = truth(inst.args[i]);
      if (t < 0) continue;
      become_value(id, inst.args[t == neutral ? 1 - i : i]);
      return true;
    }
    return false;
  }

  void fold_call(InstId id) {
    const Inst& inst = m_.insts[id];
    const ShadeopInfo& info = m_.called(inst);
    if (info.flags & (kNoFold | kEffect | kHiddenVarying) || info.kind != ShadeopKind::kKernel) return;
    if (fold_identity(id, info.name) || fold_logic(id, info.name)) return;
    if (!evaluator_ || inst.results.size() != 1) return;
    std::vector<const Constant*> args;
    for (ValueId a : inst.args) {
      args.push_back(constant(a));
      if (!args.back()) return;
    }
    std::vector<Constant> results;
    if (evaluator_->evaluate(static_cast<ShadeopId>(inst.index), args, results))
      become_constant(id, results[0]);
  }

  // Puts the body of the branch taken in place of the if; its yield's arguments replace the if's results.
  void fold_if(InstId id, std::vector<InstId>& out) {
    int condition = truth(m_.insts[id].args[0]);
    for (Region& r : m_.insts[id].regions)
      fold_region(r);
    if (condition < 0) {
      out.push_back(id);
      return;
    }
    std::vector<InstId> taken = m_.insts[id].regions[condition ? 0 : 1].body;
    changed_ = true;
    for (InstId nested : taken) {
      if (m_.insts[nested].op != Op::kYield) {
        out.push_back(nested);
        continue;
      }
      for (size_t i = 0; i < m_.insts[id].results.size(); ++i)
        replacement_[m_.insts[id].results[i]] = m_.insts[nested].args[i];
    }
  }

  void fold_region(Region& region) {
    std::vector<InstId> body = std::move(region.body), out;
    for (InstId id : body) {
      // A branch taken for certain may have ended in a break: nothing after it runs.
      if (!out.empty() && is_terminator(m_.insts[out.back()].op)) break;
      for (ValueId& a : m_.insts[id].args)
        while (a < replacement_.size() && replacement_[a] != kNoValue)
          a = replacement_[a];
      switch (m_.insts[id].op) {
      case Op::kConstant:
        constant_of_[m_.insts[id].results[0]] = static_cast<int32_t>(m_.insts[id].index);
        break;
      case Op::kRetype:
        if (const Constant* c = constant(m_.insts[id].args[0]))
          become_constant(id, {m_.type(m_.insts[id].results[0]), c->numbers, c->text});
        break;
      case Op::kCall: fold_call(id); break;
      case Op::kIf: fold_if(id, out); continue;
      default:
        for (size_t i = 0; i < m_.insts[id].regions.size(); ++i) {
          Region nested = std::move(m_.insts[id].regions[i]); // folding may grow m_.constants, not m_.insts
          fold_region(nested);
          m_.insts[id].regions[i] = std::move(nested);
        }
      }
      out.push_back(id);
    }
    region.body = std::move(out);
  }

  Module& m_;
  const ConstantEvaluator* evaluator_;
  std::vector<int32_t> constant_of_; // by value: index of the constant it is, or -1
  std::vector<ValueId> replacement_;
  bool changed_ = false;
};

} // namespace

bool fold_constants(Module& m, const ConstantEvaluator* evaluator) {
  return Folder(m, evaluator).run();
}

} // namespace slvm::ir
