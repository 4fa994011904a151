// Random programs of the shading language: every statement, every kind of declaration, and calls of every
// shadeop that needs no scene, taken from the table. They compile, end, and tell all they computed.
#pragma once

#include "tests/fuzz/programs/choices.h"

#include <string>

namespace slvm::test {

struct RandomProgram {
  /// One surface shader, "t". Its inputs are s, t, P, N and those of program_inputs(); what it computes is in
  /// its output parameters, Ci and Oi, and what it prints.
  std::string source;
  /// One light shader, "l".
  std::string light;
  /// No derivatives and no random numbers: a point's results do not depend on what grid it is on.
  bool pointwise = false;
};

RandomProgram random_program(Choices&);

/// The parameters each program has: what a test sets on its instance, or by primitive variables.
struct ProgramInput {
  const char* declaration;
  const char* name;
  bool varies; ///< as a primitive variable
};
inline constexpr ProgramInput kProgramInputs[] = {
    {"float", "pf", false},  {"uniform float", "pu", false}, {"color", "pc", false},
    {"string", "ps", false}, {"varying float", "pv", true},
};

} // namespace slvm::test
