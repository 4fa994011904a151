// Operator names.
#include "slc/ast/expr.h"

namespace slc {

std::string_view operator_text(Operator op) {
  constexpr std::string_view kTexts[] = {
      "+", "-", "*", "/", ".", "^", "==", "!=", "<", "<=", ">", ">=", "-", "!"};
  return kTexts[static_cast<int>(op)];
}

} // namespace slc
