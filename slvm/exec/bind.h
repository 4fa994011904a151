// Steps of Machine::instantiate.
#pragma once

#include "slvm/machine.h"

namespace slvm {

/// Values of parameters, by index in Program::params, in "current" space; null: the default holds, by code.
using BoundValues = std::vector<std::unique_ptr<Value>>;

/// Matches given values against parameters and brings them, and plain defaults, to "current" space.
Result<BoundValues> bind_values(const Program& program, std::span<const ParamValue> given,
                                const Matrix4& shader_to_current);

/// The program with these values folded in. Null when the program carries no IR or nothing is known.
std::unique_ptr<const Program> specialise(const Program& program, const BoundValues& values,
                                          std::span<const std::string> may_vary,
                                          const ir::ConstantEvaluator& evaluator);

/// A surface shader's program, with these values folded in, of which only `outputs` are wanted: Ci, Oi and
/// output parameters that are not among them are not computed. Null: no IR, nothing falls away, or others may
/// look at all of them while it runs (lights by surface(), functions of plug-ins).
std::unique_ptr<const Program> narrow(const Program& program, const BoundValues& values,
                                      std::span<const std::string> may_vary,
                                      std::span<const std::string> outputs,
                                      const ir::ConstantEvaluator& evaluator);

} // namespace slvm
