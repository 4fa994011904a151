// The codes of errors of the RenderMan interface (RISpec 3.2, appendix C; ri.h calls them RIE_...). Messages
// carry them as Diagnostic::code.
#pragma once

#include <cstdint>

namespace render {

enum class RiError : uint8_t {
  kNone = 0,
  kNoMemory = 1,
  kSystem = 2,
  kNoFile = 3,
  kBadFile = 4,
  kVersion = 5,
  kDiskFull = 6,
  kIncapable = 11,
  kUnimplemented = 12,
  kLimit = 13,
  kBug = 14,
  kNotStarted = 23,
  kNesting = 24,
  kNotOptions = 25,
  kNotAttributes = 26,
  kNotPrimitives = 27,
  kIllegalState = 28,
  kBadMotion = 29,
  kBadSolid = 30,
  kBadToken = 41,
  kRange = 42,
  kConsistency = 43,
  kBadHandle = 44,
  kNoShader = 45,
  kMissingData = 46,
  kSyntax = 47,
  kMath = 61,
};

} // namespace render
