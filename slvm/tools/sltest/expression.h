// RSL code without a shader around it: `sltest --expr`, the expressions that set variables of a grid,
// predicates. All of them become a surface shader with an output parameter `result` and are run by the
// virtual machine: there is no second implementation of the language.
//
// Code is an expression (`color noise(P)`) or statements (`float x = u; while (x < 1) x += x; result = x;`).
// The type of the result is the first of float, color, point, vector, normal, matrix and string with which
// the code compiles. Statements that never mention `result`, and calls of functions without a result, leave
// what they do in Ci, Oi and other variables, or in what they print.
#pragma once

#include "slvm/tools/sltest/grid_data.h"
#include "slvm/tools/sltest/library.h"
#include "slvm/tools/sltest/services.h"

#include <span>
#include <string>
#include <vector>

namespace slvm::sltest {

/// The name of the result, and of the shader made from code.
inline constexpr const char* kResultName = "result";
inline constexpr const char* kExpressionName = "expression";

struct Formal {
  std::string name;
  Type type = Type::kFloat;
  uint32_t elements = 0;
  bool varying = false;
};

bool is_statements(std::string_view code);
/// Whether `word` stands in the code as a whole identifier.
bool mentions(std::string_view code, std::string_view word);

/// Compiles code to a surface shader named "expression". `types` are the types the result may have; empty:
/// all. `label` is the file in which the code stands, for messages; it begins at the given line and column.
struct CodeOptions {
  std::string label = "--expr";
  uint32_t first_line = 1, first_column = 1;
  CompileMode mode;
  std::vector<Type> types;
  std::vector<std::string> path;
  std::string prelude; ///< lines before the shader
  std::string macros;  ///< preprocessor lines before the code
  std::string result = kResultName;
};
ShaderPtr compile_code(ShaderLibrary& library, const std::string& code, std::span<const Formal> formals,
                       const CodeOptions& options, ShaderError& error);

/// The primitive variables of a grid as formals of code.
std::vector<Formal> primvar_formals(const GridData& grid);

/// Runs code on a grid and returns the result, a varying variable.
Result<Variable> evaluate_code(ShaderLibrary& library, const std::string& code, const GridData& grid,
                               const Scene& scene, const CodeOptions& options);

} // namespace slvm::sltest
