// How the functions of ri.h are defined: each is one line of a requests_*.cpp, its arguments in the order of
// requests.def. `formals` are the C parameters in parentheses.
#pragma once

#include "render/ri/context.h"

#include <cstdarg>

#define RI_LIST(...) __VA_ARGS__

// A request without parameter list.
#define RI_PLAIN(name, formals, ...)                                                                         \
  RtVoid Ri##name formals {                                                                                  \
    if (auto* context = render::ri::current("Ri" #name))                                                     \
      context->send(render::RequestId::k##name, {} __VA_OPT__(, ) __VA_ARGS__);                              \
  }

// The ...V function and the one with variable arguments, after a last fixed one. `call` is an expression of
// `context` and `list`.
#define RI_PAIR(type, name, formals, last, call)                                                             \
  type Ri##name##V(RI_LIST formals, RtInt n, RtToken tokens[], RtPointer values[]) {                         \
    render::ri::ParameterList list{n, tokens, values};                                                       \
    auto* context = render::ri::current("Ri" #name);                                                         \
    return context ? (call) : type();                                                                        \
  }                                                                                                          \
  type Ri##name(RI_LIST formals, ...) {                                                                      \
    va_list arguments;                                                                                       \
    va_start(arguments, last);                                                                               \
    render::ri::CollectedParameters collected(arguments);                                                    \
    va_end(arguments);                                                                                       \
    render::ri::ParameterList list = collected.list();                                                       \
    auto* context = render::ri::current("Ri" #name);                                                         \
    return context ? (call) : type();                                                                        \
  }

// A request with parameter list.
#define RI_PARAMETERS(name, formals, last, ...)                                                              \
  RI_PAIR(RtVoid, name, formals, last,                                                                       \
          static_cast<void>(context->send(render::RequestId::k##name, list __VA_OPT__(, ) __VA_ARGS__)))
