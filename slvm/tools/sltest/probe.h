// The values of one variable behind one line, at each point.
#pragma once

#include "slvm/tools/sltest/grid_data.h"
#include "slvm/tools/sltest/mark_observer.h"

#include <vector>

namespace slvm::sltest {

class Probe final : public MarkObserver {
public:
  explicit Probe(const Instrumenter& instrumenter) : instrumenter_(instrumenter) {}

  /// Values of one point, one for each time it passed the line.
  struct Pass {
    std::vector<float> numbers;
    std::string text; ///< of a string
  };
  const std::vector<Pass>& passes(size_t point) const { return passes_.at(point); }
  bool reached(size_t point) const { return point < passes_.size() && !passes_[point].empty(); }
  /// The values of the last pass; points that never passed have NaN. Strings: the text.
  Variable variable() const;

protected:
  void marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) override;

private:
  const Instrumenter& instrumenter_;
  std::vector<std::vector<Pass>> passes_; ///< by point
  Type type_ = Type::kFloat;
  uint32_t elements_ = 0;
};

} // namespace slvm::sltest
