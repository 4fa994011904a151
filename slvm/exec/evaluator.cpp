// Runs one kernel for constant operands.
#include "slvm/evaluator.h"

#include "slvm/kernels/table.h"
#include "slvm/support/string_pool.h"

#include <algorithm>
#include <bit>

namespace slvm {
namespace {

class KernelEvaluator : public ir::ConstantEvaluator {
public:
  explicit KernelEvaluator(const KernelTable& table) : table_(table) {}

  bool evaluate(ShadeopId id, std::span<const ir::Constant* const> args,
                std::vector<ir::Constant>& results) const override {
    Kernel kernel = table_[id];
    Type type = shadeop(id).signature.result;
    if (!kernel || type == Type::kVoid) return false;
    size_t planes = static_cast<size_t>(components(type));
    for (const ir::Constant* c : args)
      planes += static_cast<size_t>(components(c->type));
    std::vector<float> memory((planes + 1) * kMaxLanes);
    auto misaligned = reinterpret_cast<uintptr_t>(memory.data()) / sizeof(float) % kMaxLanes;
    float* next = memory.data() + (misaligned ? kMaxLanes - misaligned : 0);
    std::vector<Operand> operands;
    auto take = [&](Type t) {
      operands.push_back({next, kMaxLanes, 0, 1});
      next += static_cast<size_t>(components(t)) * kMaxLanes;
    };
    take(type);
    for (const ir::Constant* c : args) {
      float* planes_of = next;
      take(c->type);
      if (c->type == Type::kString)
        std::fill_n(planes_of, kMaxLanes, std::bit_cast<float>(strings_.intern(c->text)));
      for (size_t i = 0; i < c->numbers.size(); ++i)
        std::fill_n(planes_of + i * kMaxLanes, kMaxLanes, c->numbers[i]);
    }
    KernelContext context{&strings_, 0, 0};
    kernel(operands.data(), static_cast<uint32_t>(operands.size()), kMaxLanes, context);
    ir::Constant result{type, {}, {}};
    if (type == Type::kString)
      result.text = strings_.text(std::bit_cast<uint32_t>(operands[0].data[0]));
    else
      for (size_t i = 0; i < static_cast<size_t>(components(type)); ++i)
        result.numbers.push_back(operands[0].plane(i)[0]);
    results.assign(1, std::move(result));
    return true;
  }

private:
  const KernelTable& table_;
  mutable StringPool strings_;
};

} // namespace

std::unique_ptr<ir::ConstantEvaluator> make_kernel_evaluator(const std::string& target) {
  const KernelTable* table = target.empty() ? &kernel_table() : find_kernel_table(target);
  return table ? std::make_unique<KernelEvaluator>(*table) : nullptr;
}

} // namespace slvm
