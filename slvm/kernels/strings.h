// Uniform strings as kernels meet them: ids in planes, texts in the pool of the context.
#pragma once

#include "slvm/support/string_pool.h"
#include "slvm/wide/operand.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace slvm {

inline std::string_view string_operand(const Operand& o, const KernelContext& context) {
  return context.strings->text(std::bit_cast<uint32_t>(o.data[0]));
}

inline void store_string(const Operand& o, size_t lanes, std::string_view text,
                         const KernelContext& context) {
  std::fill_n(o.data, lanes, std::bit_cast<float>(context.strings->intern(text)));
}

constexpr char lower_letter(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Equal but for the case of letters.
constexpr bool same_letters(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (lower_letter(a[i]) != lower_letter(b[i])) return false;
  return true;
}

} // namespace slvm
