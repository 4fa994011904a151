#include "slvm/tools/sltest/probe.h"

#include <bit>
#include <limits>

namespace slvm::sltest {

void Probe::marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) {
  if (instrumenter_.marks()[number].kind != MarkKind::kProbe) return;
  passes_.resize(step.grid().points());
  type_ = values[0].planes.type;
  elements_ = values.size() > 1 ? static_cast<uint32_t>(values.size()) : 0;
  for_each_active(step, [&](size_t point, size_t i) {
    Pass& pass = passes_[point].emplace_back();
    for (const StepOperand& o : values) {
      if (type_ == Type::kString) {
        if (!pass.text.empty()) pass.text += ' ';
        pass.text += step.strings().text(std::bit_cast<uint32_t>(o.planes.get(0, i)));
        continue;
      }
      for (size_t k = 0; k < static_cast<size_t>(components(type_)); ++k)
        pass.numbers.push_back(o.planes.get(k, i));
    }
  });
}

Variable Probe::variable() const {
  Variable v{instrumenter_.options().probe->name, type_, elements_, true, {}, {}};
  if (type_ == Type::kString) {
    v.varying = false;
    v.elements = 0;
    for (const std::vector<Pass>& list : passes_)
      if (v.strings.empty() && !list.empty()) v.strings.push_back(list.back().text);
    return v;
  }
  const size_t points = passes_.size();
  v.numbers.assign(v.planes() * points, std::numeric_limits<float>::quiet_NaN());
  for (size_t i = 0; i < points; ++i)
    for (size_t k = 0; k < v.planes() && !passes_[i].empty(); ++k)
      v.numbers[k * points + i] = passes_[i].back().numbers[k];
  return v;
}

} // namespace slvm::sltest
