// Decompression with zlib.
#include "render/rib/gzip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

namespace render {

Unpacked unpack_gzip(std::string_view bytes, size_t limit) {
  Unpacked out;
  z_stream stream{};
  constexpr int kGzipOnly = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) {
    out.error = "gzip decompression cannot be started";
    return out;
  }
  size_t given = 0; // bytes handed to zlib in earlier rounds and used up
  char buffer[1 << 16];
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  while (out.error.empty()) {
    size_t left = bytes.size() - given;
    auto round = static_cast<uInt>(std::min<size_t>(left, std::numeric_limits<uInt>::max()));
    stream.avail_in = round;
    stream.next_out = reinterpret_cast<Bytef*>(buffer);
    stream.avail_out = sizeof buffer;
    int status = inflate(&stream, Z_NO_FLUSH);
    given += round - stream.avail_in;
    out.text.append(buffer, sizeof buffer - stream.avail_out);
    if (out.text.size() > limit) {
      out.text.resize(limit);
      out.error =
          fmt::format("the compressed file unpacks to more than {} MB; the rest is not read", limit >> 20);
    } else if (status == Z_STREAM_END) {
      // Another member may follow; anything else after the end is padding.
      if (!is_gzip(bytes.substr(given))) break;
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR && given == bytes.size()) {
      out.error = fmt::format("the compressed file ends too early, at byte {}", given);
    } else if (status != Z_OK) {
      out.error = fmt::format("the compressed file is damaged near byte {}{}{}", given,
                              stream.msg ? ": " : "", stream.msg ? stream.msg : "");
    }
  }
  inflateEnd(&stream);
  return out;
}

} // namespace render
