// Why values vary: kept while contexts.cpp works out that they do, told by notes of errors and by
// slc --explain-varying. A cause is made when something is first found varying, and refers to earlier ones
// only; whoever makes causes keeps them.
#pragma once

#include "slvm/support/diagnostics.h"

#include <string_view>
#include <vector>

namespace slc {

struct Cause;

/// What makes an expression vary: the first thing in it, in the order of evaluation.
struct Reason {
  enum Kind : uint8_t {
    kNone,     ///< nothing is known
    kGlobal,   ///< a predefined variable
    kVariable, ///< a variable; `cause` says why that varies
    kBuiltin,  ///< a built-in whose result varies whatever it is given
    kFunction, ///< a function of the source; `cause` says why its result varies
  } kind = kNone;
  slvm::SourceRange where;
  std::string_view name;
  const Cause* cause = nullptr;
};

/// Why a variable, a result, or the control around a statement varies.
struct Cause {
  enum Kind : uint8_t {
    // A variable `name`:
    kDeclared, ///< declared varying
    kSet,      ///< set from something varying
    kSetUnder, ///< set under varying control
    kGiven,    ///< a formal, called with something varying
    // The result of function `name`:
    kReturned,      ///< something varying is returned
    kReturnedUnder, ///< something is returned under varying control
    // Control:
    kCondition,    ///< a varying condition
    kLights,       ///< illuminance, illuminate, solar
    kRays,         ///< gather, traverse
    kLoopLeft,     ///< some points have left the loop, or gone to its next round
    kReturnedFrom, ///< some points have returned
  } kind = kDeclared;
  slvm::SourceRange where;
  std::string_view name;
  Reason reason;                  ///< of the value or condition; none where there is `control`
  const Cause* control = nullptr; ///< of the statement at `where`
};

/// The chain, nearest first: "'c' is varying: it is set from 'r' here", "'r' is varying: ...".
std::vector<slvm::Note> steps(const Cause& cause);
/// The first step behind a varying expression: one, or none when nothing is known.
std::vector<slvm::Note> nearest_step(const Reason& reason);

} // namespace slc
