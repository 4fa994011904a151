// Meets the marks of an instrumented program (instrument.h) while it runs.
#pragma once

#include "slvm/exec/observer.h"
#include "slvm/tools/sltest/instrument.h"

namespace slvm::sltest {

class MarkObserver : public ExecutionObserver {
public:
  bool before(const ExecutionStep& step) final;

protected:
  /// A mark by its number, at the active points of the step, with the values it was given.
  virtual void marked(uint32_t number, const ExecutionStep& step, std::span<const StepOperand> values) = 0;
};

/// Calls visit(point of the grid, point of the step) for each active point.
template <class Visitor> void for_each_active(const ExecutionStep& step, Visitor&& visit) {
  const std::span<const uint64_t> mask = step.mask();
  for (size_t i = 0; i < step.points(); ++i)
    if (mask[i / 64] >> (i % 64) & 1) visit(step.first_point() + i, i);
}

} // namespace slvm::sltest
