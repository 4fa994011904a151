// Opening TIFF files with libtiff's messages kept in a string, for those who link libtiff. PUBLIC
#pragma once

#include <tiffio.h>

#include <cstdio>
#include <memory>
#include <string>

namespace slvm {

struct CloseTiff {
  void operator()(TIFF* t) const { TIFFClose(t); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

/// Null: it cannot be opened. The first error of libtiff, now and as long as the file is open, goes to
/// `message`, which must live as long; nothing goes to the terminal. `mode`: as in TIFFOpen().
inline TiffFile open_tiff(const std::string& path, const char* mode, std::string& message) {
  std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                       TIFFOpenOptionsFree);
  if (!options) return nullptr;
  auto keep = [](TIFF*, void* text, const char*, const char* format, va_list arguments) {
    char line[512];
    std::vsnprintf(line, sizeof line, format, arguments);
    auto& first = *static_cast<std::string*>(text);
    if (first.empty()) first = line;
    return 1;
  };
  auto ignore = [](TIFF*, void*, const char*, const char*, va_list) { return 1; };
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore, nullptr);
  return TiffFile(TIFFOpenExt(path.c_str(), mode, options.get()));
}

} // namespace slvm
