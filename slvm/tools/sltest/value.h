// Values as a test file or the command line gives them, before their type is known, and what becomes of them
// once it is. A RawValue is numbers, or texts, or a text that may be an RSL expression; only the parameter or
// variable it is meant for decides which.
#pragma once

#include "slvm/format/types.h"
#include "slvm/support/result.h"
#include "slvm/value.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slvm::sltest {

/// A place in a test file, for messages. Line 0: given on the command line. Texts begin at `column`
/// themselves, behind their quotes.
struct Where {
  std::string file;
  uint32_t line = 0, column = 0;
};
/// "file:line"; the file alone, or "command line", when there is no more.
std::string to_string(const Where&);

struct RawValue {
  std::vector<float> numbers;
  std::vector<std::string> strings;
  bool list = false;  ///< written as a list
  uint32_t inner = 0; ///< a list of lists: how many numbers each inner list has
  Where where;

  bool is_text() const { return !strings.empty() && numbers.empty(); }
};

/// `[uniform|varying] [type[n]] name`, as in RIB.
struct Declaration {
  std::string name;
  std::optional<Detail> detail;
  std::optional<Type> type;
  uint32_t elements = 0;
};
Result<Declaration> parse_declaration(std::string_view text);

/// A name with a value: a parameter, a variable of the grid, an attribute.
struct Setting {
  Declaration what;
  RawValue value;
};

/// A value typed on the command line: numbers separated by blanks or commas, in brackets or not, or else a
/// text.
RawValue parse_raw(std::string_view text);

/// The type a value has by itself: a text is a string, 1 number a float, 3 a color, 16 a matrix, others
/// float[n].
Declaration inferred_type(const RawValue&, const Declaration&);

/// The value as `type` (an array of it when `elements` is not 0). One number stands for all components of a
/// triple and for the diagonal of a matrix. The error says how many were wanted.
Result<Value> to_value(const RawValue&, Type type, uint32_t elements);

/// Plane after plane the values of `points` points: numbers[plane * points + point]. The list holds one value
/// a point.
Result<std::vector<float>> to_planes(const RawValue&, Type type, size_t points);

/// "float", "color[2]".
std::string type_text(Type type, uint32_t elements);

/// Numbers separated by blanks, as %g.
std::string numbers_text(const std::vector<float>& numbers, int digits = 6);

} // namespace slvm::sltest
