#include "slvm/tools/sltest/mark_observer.h"

#include <bit>
#include <charconv>

namespace slvm::sltest {

bool MarkObserver::before(const ExecutionStep& step) {
  const ShadeopInfo* call = step.call();
  if (!call || (call->name != "printf" && call->name != "printonce")) return true; // of uniform values
  const std::vector<StepOperand> operands = step.operands();
  const std::string_view pattern = step.strings().text(std::bit_cast<uint32_t>(operands[0].planes.get(0, 0)));
  if (!pattern.starts_with(kMarkByte)) return true;
  uint32_t number = 0;
  std::from_chars(pattern.data() + 1, pattern.data() + pattern.size(), number);
  marked(number, step, std::span(operands).subspan(1));
  return false;
}

} // namespace slvm::sltest
