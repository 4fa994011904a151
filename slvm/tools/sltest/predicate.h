// Conditions over what a shader was given and what it computed, evaluated by the virtual machine on the same
// grid.
//
// In a predicate the name of an output stands for what the shader computed; in_P, in_N and so on stand for
// what a variable was before the shader changed it. A condition that RSL does not allow on triples, such as
// `abs(Ci - color(u, v, 0)) < 1e-5`, is taken to hold where it holds for each component by itself.
#pragma once

#include "slvm/tools/sltest/expression.h"
#include "slvm/tools/sltest/run.h"

namespace slvm::sltest {

/// Options for code that stands in a test file.
CodeOptions code_options(const RawValue& code, const std::vector<std::string>& path);

/// Whether the condition holds, point by point.
Result<std::vector<bool>> evaluate_predicate(ShaderLibrary& library, const RawValue& condition,
                                             const Prepared& prepared, const RunResult& result,
                                             const std::vector<std::string>& path);

} // namespace slvm::sltest
