// What a family of kernels (one .cpp file here) needs to enter its kernels into the table: see rows.inc.
#pragma once

#include "slvm/format/signature.h"
#include "slvm/wide/operand.h"

#include <type_traits>

namespace slvm {

// Every kernel's name is declared here with a type of its own. Inside a family's namespace a name finds the
// kernel if the family defines it, and otherwise this declaration, which says "look elsewhere".
struct Elsewhere {};
#define SHADEOP(name, signature, kernel, flags, ulps, doc) Elsewhere kernel();
#define GRIDOP(name, signature, function, flags, doc)
#define RSLOP(name, signature, flags, doc)
#define PENDING(name, signature, flags, doc)
#include "slvm/format/shadeops.def"
#undef SHADEOP
#undef GRIDOP
#undef RSLOP
#undef PENDING

template <class Function> inline constexpr bool kIsElsewhere = std::is_same_v<Function, Elsewhere()>;

} // namespace slvm
