// A typed value outside compiled code: a shader parameter's value, the answer to an attribute query. PUBLIC.
#pragma once

#include "slvm/format/types.h"

#include <cstdint>
#include <string>
#include <vector>

namespace slvm {

struct Value {
  Type type = Type::kFloat;
  uint32_t elements = 0;      ///< array length; 0: not an array
  std::vector<float> numbers; ///< components() floats an element (matrices row by row); empty for strings
  std::vector<std::string> strings; ///< one an element; empty otherwise
  bool integers =
      false; ///< declared as whole numbers, which the language does not have: plug-ins see them so

  size_t count() const { return elements ? elements : 1; }
  bool operator==(const Value&) const = default;
};

} // namespace slvm
