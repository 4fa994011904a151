// The text form of a program, for --dump=bytecode and tests. PUBLIC.
#pragma once

#include "slvm/format/program.h"

#include <string>

namespace slvm {

std::string disassemble(const Program& program);

} // namespace slvm
