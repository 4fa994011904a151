// From a ShaderRef to a compiled shader, whatever its form.
#pragma once

#include "slvm/tools/sltest/expression.h"
#include "slvm/tools/sltest/run.h"

namespace slvm::sltest {

/// `formals`: what an expression may use beside its own parameters.
ShaderPtr obtain(const Setup& setup, const ShaderRef& ref, std::span<const Formal> formals,
                 ShaderLibrary& library, CompileMode mode, RunError& error);

} // namespace slvm::sltest
