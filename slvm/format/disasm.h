// The text form of a program, for `slc --dump=bytecode`, `sloinfo --disassemble` and tests. PUBLIC.
#pragma once

#include "slvm/format/program.h"

#include <functional>
#include <string>

namespace slvm {

/// The text of a line of the source; "" where it is not known. `file`: index into Program::files.
using LineText = std::function<std::string(uint32_t file, uint32_t line)>;

/// One instruction a line. With `text`, source lines stand between instructions, each before the first one
/// made for it; without, instructions end in their line numbers.
std::string disassemble(const Program& program, const LineText& text = {});

} // namespace slvm
