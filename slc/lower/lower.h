// From the checked syntax tree to IR: one shader at a time, functions inlined, variables turned into SSA
// values.
#pragma once

#include "slc/ast/unit.h"
#include "slvm/ir/ir.h"

#include <string>
#include <vector>

namespace slc {

/// `files`: names of source files by FileId, for the line table. `calls` receives the calls of built-ins in
/// the source, inlined ones too, in order; none twice.
slvm::ir::Module lower_shader(const Shader& shader, std::vector<std::string> files,
                              std::vector<slvm::SourceCall>& calls);

/// What introspection tells beside the parameters, read off the (optimised) code. Of `calls` those are kept
/// of which code is left.
slvm::Facts collect_facts(const slvm::ir::Module& m, const std::vector<slvm::SourceCall>& calls);

/// After optimisation: settles what each parameter's default is (a constant in some space, or code), and
/// drops code that only computes a constant.
void settle_defaults(slvm::ir::Module& m);

} // namespace slc
