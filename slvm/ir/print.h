// The text form of IR, for --dump=ir and the tests of passes.
#pragma once

#include "slvm/ir/ir.h"

namespace slvm::ir {

std::string print(const Module& m);

} // namespace slvm::ir
