// Prototypes of functions in plug-ins, as strings in their tables: "float sqr_p(point)",
// "uniform color blend(uniform string mode, color a, output color b, float[3])".
//
//   prototype = { "uniform" | "varying" } type [ "[" [ number ] "]" ] name "(" [ "void" | param { "," param }
//   ] ")" [ ";" ] param     = { "uniform" | "varying" | "output" } type [ "[" [ number ] "]" ] [ name [ "[" [
//   number ] "]" ] ]
//
// Whatever stands for a name is one: real tables have "float float". The strings come from native code, but
// tables may be wrong or not end: everything is bounded.
#pragma once

#include "slvm/format/plugin_shadeop.h"
#include "slvm/support/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace slvm {

struct PrototypeParam {
  Type type = Type::kFloat;
  bool uniform = false, output = false, array = false;
  uint32_t elements = 0; ///< of an array; 0: any number
  std::string name;      ///< "" where the prototype has none
};

struct Prototype {
  Type result = Type::kVoid;
  bool uniform_result = false, varying_result = false;
  bool array_result = false; ///< it returns an array: an output, the first of `params`, and `result` is void
  std::string name;
  std::vector<PrototypeParam> params;

  /// In the grammar of slvm/format/signature.h, as PluginFunctionName has it.
  std::string signature() const;
};

/// Characters of the longest prototype that is read.
inline constexpr size_t kMaxPrototype = 8192;

/// The error says what is wrong, without the text.
Result<Prototype> parse_prototype(std::string_view text);

} // namespace slvm
