// One call of a shadeop in a shader, in every way its operands can be given: what matrix_test.cpp runs.
#pragma once

#include "slvm/format/shadeop_info.h"
#include "slvm/grid.h"
#include "slvm/support/string_pool.h"

#include <random>
#include <string>
#include <vector>

namespace slvm::test {

/// How an operand is given: a literal in the source, a uniform parameter, a primitive variable.
enum class OperandClass { kConstant, kUniform, kVarying };

struct MatrixOperand {
  Type type = Type::kFloat;
  uint32_t elements = 0; ///< of an array, else 0
  bool must_be_uniform = false;
  std::string text;         ///< of strings, which are always literals
  std::vector<float> first; ///< its value at the first point, and everywhere unless it varies
};

/// A row of the table with operands. Not every row can be had: see can_call().
class MatrixCall {
public:
  MatrixCall(ShadeopId, std::mt19937&);

  static bool can_call(ShadeopId);

  /// A surface "t" whose outputs r0, r1... get what the call gives, where primitive variable m is 1, and else
  /// keep their initial value 7. classes: one for each operand.
  std::string source(const std::vector<OperandClass>& classes) const;
  /// Primitive variables of a grid for this call: operands that are not varying in `values` repeat their
  /// first value.
  void fill(Grid&, const std::vector<OperandClass>& values) const;

  size_t operands() const { return operands_.size(); }
  const MatrixOperand& operand(size_t i) const { return operands_[i]; }
  const std::vector<Type>& results() const { return results_; }

private:
  ShadeopId row_;
  std::vector<MatrixOperand> operands_;
  std::vector<Type> results_;
};

} // namespace slvm::test
