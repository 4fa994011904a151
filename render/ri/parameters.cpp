// Reading variable arguments.
#include "render/ri/parameters.h"

#include <cstddef>

namespace render::ri {

CollectedParameters::CollectedParameters(va_list arguments) {
  // A list without RI_NULL at its end has no end at all; this many no one means.
  constexpr size_t kMost = 4096;
  while (tokens_.size() < kMost) {
    RtToken token = va_arg(arguments, RtToken);
    if (!token) return;
    tokens_.push_back(token);
    values_.push_back(va_arg(arguments, RtPointer));
  }
}

} // namespace render::ri
