// Strength reduction: the same value by a cheaper call. Squares and roots written as powers become products
// and roots; a float that was spread over three components only to be multiplied or divided by is used as it
// is.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <fmt/format.h>

namespace slvm::ir {
namespace {

class StrengthReduction {
public:
  explicit StrengthReduction(Module& m) : m_(m), definition_(m.values.size(), ~0u) {
    square_ = row("operator*", "float(float a, float b)");
    root_ = row("sqrt", "float(float x)");
    pow_ = row("pow", "float(float x, float y)");
    for (size_t i = 0; i < std::size(kTriples); ++i) {
      std::string_view t = type_name(kTriples[i]);
      spread_[i] = row("convert", fmt::format("{}(float x)", t));
      product_[i] = row("operator*", fmt::format("{0}({0} a, {0} b)", t));
      scaled_[i] = row("operator*", fmt::format("{0}({0} a, float b)", t));
      scaling_[i] = row("operator*", fmt::format("{0}(float a, {0} b)", t));
      quotient_[i] = row("operator/", fmt::format("{0}({0} a, {0} b)", t));
      divided_[i] = row("operator/", fmt::format("{0}({0} a, float b)", t));
    }
  }

  bool run() {
    for_each_root(m_, [&](Region& r) {
      for_each_inst(m_, r, [&](InstId id) {
        for (ValueId v : m_.insts[id].results)
          definition_[v] = id;
        reduce_power(m_.insts[id]);
        use_float(m_.insts[id]);
      });
    });
    return changed_;
  }

private:
  static constexpr Type kTriples[] = {Type::kColor, Type::kPoint, Type::kVector, Type::kNormal};

  static int row(std::string_view name, std::string_view signature) { return find_shadeop(name, signature); }
  bool is_call(const Inst& inst, int id) const {
    return inst.op == Op::kCall && id >= 0 && inst.index == static_cast<uint32_t>(id);
  }
  const Inst* definition(ValueId v) const {
    return v < definition_.size() && definition_[v] != ~0u ? &m_.insts[definition_[v]] : nullptr;
  }

  void become(Inst& inst, int id, std::vector<ValueId> args) {
    inst.index = static_cast<uint32_t>(id);
    inst.args = std::move(args);
    changed_ = true;
  }

  // The kernel rounds squares and roots once, so that these are the same to the last bit; other powers would
  // not be.
  void reduce_power(Inst& inst) {
    if (!is_call(inst, pow_)) return;
    const Inst* exponent = definition(inst.args[1]);
    if (!exponent || exponent->op != Op::kConstant) return;
    float y = m_.constants[exponent->index].numbers[0];
    ValueId x = inst.args[0];
    if (y == 2) become(inst, square_, {x, x});
    if (y == 0.5f) become(inst, root_, {x});
  }

  /// The float that was spread into `v`, or kNoValue.
  ValueId spread_from(ValueId v, size_t triple) const {
    const Inst* d = definition(v);
    return d && is_call(*d, spread_[triple]) ? d->args[0] : kNoValue;
  }

  void use_float(Inst& inst) {
    for (size_t i = 0; i < std::size(kTriples); ++i) {
      bool product = is_call(inst, product_[i]), quotient = is_call(inst, quotient_[i]);
      if (!product && !quotient) continue;
      ValueId left = spread_from(inst.args[0], i), right = spread_from(inst.args[1], i);
      if (right != kNoValue) return become(inst, product ? scaled_[i] : divided_[i], {inst.args[0], right});
      if (product && left != kNoValue) return become(inst, scaling_[i], {left, inst.args[1]});
    }
  }

  Module& m_;
  std::vector<InstId> definition_; // by value
  int square_, root_, pow_;
  int spread_[4], product_[4], scaled_[4], scaling_[4], quotient_[4], divided_[4];
  bool changed_ = false;
};

} // namespace

bool reduce_strength(Module& m) {
  return StrengthReduction(m).run();
}

} // namespace slvm::ir
