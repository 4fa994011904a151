// The error handlers of ri.h.
#include "render/ri/context.h"

#include <cstdio>
#include <cstdlib>

namespace {

void print(RtInt code, RtInt severity, const char* message) {
  constexpr const char* kSeverities[] = {"note", "warning", "error", "severe error"};
  const char* name = severity >= RIE_INFO && severity <= RIE_SEVERE ? kSeverities[severity] : "error";
  fmt::print(stderr, "ri: {}: {} ({})\n", name, message ? message : "", code);
}

} // namespace

extern "C" {

RtVoid RiErrorIgnore(RtInt, RtInt, char*) {}

RtVoid RiErrorPrint(RtInt code, RtInt severity, char* message) {
  print(code, severity, message);
}

/// Warnings are no reason to end. Threads may be rendering: nothing is taken away from them.
RtVoid RiErrorAbort(RtInt code, RtInt severity, char* message) {
  print(code, severity, message);
  if (severity < RIE_ERROR) return;
  render::ri::abandon_files();
  std::fflush(nullptr);
  std::_Exit(EXIT_FAILURE);
}

} // extern "C"
