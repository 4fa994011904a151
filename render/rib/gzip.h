// Files compressed with gzip.
#pragma once

#include <string>
#include <string_view>

namespace render {

struct Unpacked {
  std::string text;  ///< as far as it could be had
  std::string error; ///< empty: all of it
};

inline bool is_gzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

/// The content of a gzip file, of all its members one after the other. A file that grows past `limit` bytes
/// is an error.
Unpacked unpack_gzip(std::string_view bytes, size_t limit);

} // namespace render
