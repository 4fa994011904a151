// The requests of the RenderMan interface as data: names, argument kinds and documentation come from
// requests.def; RequestCall is one parsed call. Read next: ri_target.h (who receives calls), parser.h (who
// makes them).
#pragma once

#include "slvm/support/source.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace render {

enum class RequestId : uint8_t {
#define REQUEST(name, arguments, where, lacks, doc) k##name,
#include "render/rib/requests.def"
#undef REQUEST
  kCount
};
inline constexpr int kRequestCount = static_cast<int>(RequestId::kCount);

enum class ArgumentKind : uint8_t {
  kFloat,
  kInt,
  kString,
  kFloats, ///< `count` numbers when count > 0, any number of them otherwise
  kInts,
  kStrings,
  kHandle,
  kBasis,
  kDash,
};

struct ArgumentInfo {
  ArgumentKind kind = ArgumentKind::kFloat;
  int count = 1; ///< floats it holds when fixed; 0 for arrays of any length
  bool optional = false;
  std::string_view name;
};

struct RequestInfo {
  RequestId id;
  std::string_view name;
  std::vector<ArgumentInfo> arguments;
  bool params = false;    ///< a token-value list follows the arguments
  bool outside = false;   ///< legal outside the world block
  bool world = false;     ///< legal inside it
  std::string_view lacks; ///< what the picture lacks, empty when the request is carried out
  std::string_view doc;
  /// Numbers all arguments hold together when they are nothing but fixed counts of numbers, so that they may
  /// come as one array; else 0.
  int flat_count = 0;
};

std::span<const RequestInfo> requests();
const RequestInfo& request_info(RequestId);
/// The row of this name (case matters), or nullptr.
const RequestInfo* find_request(std::string_view name);
/// The request nearest to a misspelt name; empty if none is near.
std::string_view suggest_request(std::string_view name);

/// One argument of a call. Which vector is filled follows from its kind; a basis fills strings or numbers.
struct Argument {
  std::vector<float> numbers;
  std::vector<int> ints;
  std::vector<std::string> strings;
  slvm::SourceRange where;
  bool present = false;

  void clear();
};

/// One token-value pair as written: "Kd" 0.8 or "uniform color c" [1 0 0]. Types are the receiver's business.
struct Param {
  std::string token;
  std::vector<float> numbers;
  std::vector<std::string> strings;
  bool integers = true; ///< every number was written without point and exponent
  slvm::SourceRange where;
  bool is_string() const { return !strings.empty(); }
};

struct RequestCall {
  RequestId id = RequestId::kCount;
  slvm::SourceRange where; ///< the request's name
  std::vector<Argument> arguments;
  std::vector<Param> params;
  /// ArchiveBegin with content other than plain RIB: the bytes up to the line of its ArchiveEnd.
  std::string data;

  const RequestInfo& info() const { return request_info(id); }
  bool has(int i) const { return arguments[i].present; }
  float number(int i) const { return arguments[i].numbers[0]; }
  int integer(int i) const { return arguments[i].ints[0]; }
  const std::string& text(int i) const { return arguments[i].strings[0]; }
  std::span<const float> numbers(int i) const { return arguments[i].numbers; }
  std::span<const int> integers(int i) const { return arguments[i].ints; }
  std::span<const std::string> texts(int i) const { return arguments[i].strings; }
  const Param* find_param(std::string_view token) const;
  /// ArchiveBegin of another type, or encoded (multipart RIB): what follows is no concern of parsers of RIB.
  bool holds_data() const;
};

} // namespace render
