// Parameter lists as C programs hand them over.
#pragma once

#include "render/ri/ri.h"

#include <cstdarg>
#include <vector>

namespace render::ri {

/// Pairs of a token and a pointer to its values, as the ...V functions have them.
struct ParameterList {
  RtInt count = 0;
  const RtToken* tokens = nullptr;
  const RtPointer* values = nullptr;
};

/// The same from "token, pointer, ... RI_NULL".
class CollectedParameters {
public:
  explicit CollectedParameters(va_list arguments);
  ParameterList list() const { return {static_cast<RtInt>(tokens_.size()), tokens_.data(), values_.data()}; }

private:
  std::vector<RtToken> tokens_;
  std::vector<RtPointer> values_;
};

} // namespace render::ri
