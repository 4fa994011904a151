// Vector fusion: a product that only a sum uses is computed with it, in one instruction. Half of the
// instructions of noise sums and lighting are such pairs; fused, the product never leaves its registers. Both
// are rounded, as written, so that results are the same bits.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/build.h"

#include <fmt/format.h>

namespace slvm::ir {
namespace {

class Fusion {
public:
  explicit Fusion(Module& m) : m_(m), uses_(m.values.size(), 0) {
    for (Type t : {Type::kFloat, Type::kColor, Type::kVector, Type::kPoint})
      add_rows(t);
  }

  bool run() {
    for_each_root(m_, [&](Region& r) {
      for_each_inst(m_, r, [&](InstId id) {
        for (ValueId v : m_.insts[id].args)
          ++uses_[v];
      });
      visit(r);
    });
    return changed_;
  }

private:
  /// Two rows and the one they become, whose factors may stand the other way round.
  struct Pair {
    int product, sum, sum_swapped, fused;
    bool turned;
  };

  void add_rows(Type t) {
    const std::string_view sum = type_name(t), factor = type_name(t == Type::kPoint ? Type::kVector : t);
    add_rows(sum, factor, factor, factor, false);
    if (t == Type::kFloat) return;
    add_rows(sum, factor, factor, "float", false);
    add_rows(sum, factor, "float", factor, true);
  }
  void add_rows(std::string_view sum, std::string_view product, std::string_view a, std::string_view b,
                bool turned) {
    Pair p{
        find_shadeop("operator*", fmt::format("{}({} a, {} b)", product, a, b)),
        find_shadeop("operator+", fmt::format("{0}({0} a, {1} b)", sum, product)),
        find_shadeop("operator+", fmt::format("{0}({1} a, {0} b)", sum, product)),
        find_shadeop("muladd", fmt::format("{0}({1} a, {2} b, {0} c)", sum, turned ? b : a, turned ? a : b)),
        turned};
    if (p.product >= 0 && p.sum >= 0 && p.fused >= 0) pairs_.push_back(p);
  }

  static bool is_call(const Inst& inst, int id) {
    return inst.op == Op::kCall && inst.index == static_cast<uint32_t>(id);
  }

  // Only within a region: elsewhere the product may be computed for other points, or fewer times.
  void visit(Region& region) {
    std::vector<InstId> definition(m_.values.size(), ~0u);
    std::vector<bool> fused(m_.insts.size(), false);
    for (InstId id : region.body) {
      for (Region& nested : m_.insts[id].regions)
        visit(nested);
      fuse(m_.insts[id], definition, fused);
      for (ValueId v : m_.insts[id].results)
        definition[v] = id;
    }
    std::erase_if(region.body, [&](InstId id) { return fused[id]; });
  }

  void fuse(Inst& inst, const std::vector<InstId>& definition, std::vector<bool>& fused) {
    for (const Pair& p : pairs_)
      for (size_t which : {0u, 1u}) {
        if (!is_call(inst, which == 0 ? p.sum_swapped : p.sum)) continue;
        const ValueId product = inst.args[which];
        if (uses_[product] != 1 || definition[product] == ~0u) continue;
        const Inst& multiply = m_.insts[definition[product]];
        if (!is_call(multiply, p.product)) continue;
        fused[definition[product]] = true;
        inst.args = {multiply.args[p.turned], multiply.args[!p.turned], inst.args[1 - which]};
        inst.index = static_cast<uint32_t>(p.fused);
        changed_ = true;
        return;
      }
  }

  Module& m_;
  std::vector<uint32_t> uses_; // by value
  std::vector<Pair> pairs_;
  bool changed_ = false;
};

} // namespace

bool fuse_products(Module& m) {
  return Fusion(m).run();
}

} // namespace slvm::ir
