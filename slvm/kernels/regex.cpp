// match() by the standard library, kept within bounds: patterns may come from hostile files, and the
// library's matcher recurses once per state of the expression.
#include "slvm/kernels/regex.h"

#include <algorithm>
#include <charconv>
#include <regex>

namespace slvm {
namespace {

constexpr size_t kMaxSubject = 1024;
/// Greatest length of a pattern once its counted repetitions {n,m} are written out.
constexpr size_t kMaxExpanded = 1024;

/// An upper bound of that length: counts multiply as if they were nested.
size_t expanded_length(std::string_view pattern) {
  size_t length = pattern.size();
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{' && pattern[i] != ',') continue;
    unsigned times = 1;
    std::from_chars_result parsed =
        std::from_chars(pattern.data() + i + 1, pattern.data() + pattern.size(), times);
    if (parsed.ec == std::errc::result_out_of_range) return kMaxExpanded + 1;
    length *= std::clamp<size_t>(times, 1, kMaxExpanded + 1);
    if (length > kMaxExpanded) break;
  }
  return length;
}

auto regex_flags() {
#ifdef __GLIBCXX__
  return std::regex::ECMAScript | std::regex_constants::__polynomial; // no exponential search
#else
  return std::regex::ECMAScript;
#endif
}

} // namespace

bool regex_found(std::string_view pattern, std::string_view subject) {
  if (subject.size() > kMaxSubject || expanded_length(pattern) > kMaxExpanded) return false;
  try {
    std::regex expression(pattern.begin(), pattern.end(), regex_flags());
    return std::regex_search(subject.begin(), subject.end(), expression);
  } catch (const std::regex_error&) {
    return false;
  }
}

} // namespace slvm
