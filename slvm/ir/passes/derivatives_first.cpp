// The order of a shader's outermost instructions. Those inside loops and conditions stay where they are: a
// region that differentiates is as a whole what derivatives depend on.
#include "slvm/ir/passes/passes.h"

namespace slvm::ir {
namespace {

class Ordering {
public:
  explicit Ordering(Module& m) : m_(m), body_(m.body.body), place_(m.values.size(), kNowhere) {}

  bool run() {
    for (size_t i = 0; i < body_.size(); ++i)
      for (ValueId v : inst(i).results)
        place_[v] = i;
    depends_.resize(body_.size());
    differentiates_.resize(body_.size());
    for (size_t i = 0; i < body_.size(); ++i) {
      find_calls(body_[i], i);
      if (plugins_) return false;
    }
    // What derivatives are of, and regions with derivatives in them.
    for (size_t i = 0; i < body_.size(); ++i) {
      if (!differentiates_[i]) continue;
      if (inst(i).op == Op::kCall)
        take_inputs(i);
      else
        take(i);
    }
    std::vector<InstId> order[3];
    for (size_t i = 0; i < body_.size(); ++i)
      order[depends_[i] ? 0 : differentiates_[i] ? 1 : 2].push_back(body_[i]);
    std::vector<InstId> body;
    for (const auto& part : order)
      body.insert(body.end(), part.begin(), part.end());
    const bool changed = body != body_;
    body_ = std::move(body);
    return changed;
  }

private:
  static constexpr size_t kNowhere = ~size_t{0};
  const Inst& inst(size_t i) const { return m_.insts[body_[i]]; }

  void find_calls(InstId id, size_t at) {
    const Inst& inst = m_.insts[id];
    if (names_shadeop(inst.op)) {
      plugins_ |= m_.plugins.find(static_cast<ShadeopId>(inst.index)) != nullptr;
      differentiates_[at] = differentiates_[at] || m_.called(inst).flags & kDerivative;
    }
    for (const Region& r : inst.regions)
      for (InstId nested : r.body)
        find_calls(nested, at);
  }

  /// Has the instruction at `i` run in front, with all that it needs.
  void take(size_t i) {
    if (depends_[i]) return;
    depends_[i] = true;
    take_inputs(i);
  }
  void take_inputs(size_t i) {
    take_arguments(body_[i]);
    for (size_t before = 0; before < i; ++before)
      if (!depends_[before] && must_precede(inst(before), inst(i))) take(before);
  }
  void take_arguments(InstId id) {
    for (ValueId v : m_.insts[id].args)
      if (place_[v] != kNowhere) take(place_[v]);
    for (const Region& r : m_.insts[id].regions)
      for (InstId nested : r.body)
        take_arguments(nested);
  }

  /// Whether the order of two instructions matters.
  bool must_precede(const Inst& before, const Inst& after) const {
    const Effect a = effect_of(m_, before), b = effect_of(m_, after);
    return a != Effect::kNone && b != Effect::kNone && (a == Effect::kWrites || b == Effect::kWrites);
  }

  Module& m_;
  std::vector<InstId>& body_;
  std::vector<size_t> place_;                  ///< by value: which instruction of the body it is a result of
  std::vector<bool> depends_, differentiates_; ///< by place: a derivative depends on it; is or holds one
  bool plugins_ = false;                       ///< these may do anything, in their order
};

} // namespace

bool derivatives_first(Module& m) {
  return Ordering(m).run();
}

} // namespace slvm::ir
