// The bytecode verifier: runs on every load, in every build. After it a program cannot make the virtual
// machine read or write outside its registers, jump anywhere but to brackets of its own regions, or unbalance
// the mask stack.
#pragma once

#include "slvm/format/program.h"

#include <string>

namespace slvm {

/// Limits a program must keep, so that a hostile one cannot ask for absurd memory.
inline constexpr uint32_t kMaxPlanes = 1u << 16;
inline constexpr uint32_t kMaxUniformPlanes = 1u << 20; ///< tables in uniform arrays are large
inline constexpr uint32_t kMaxMaskDepth = 256;

/// Whether the default of a parameter, if it is known, has the type and the length that the parameter has.
bool default_fits(const Param& param);

/// "" when sound, else what is wrong, with the word of code concerned.
std::string verify_program(const Program& program);

} // namespace slvm
