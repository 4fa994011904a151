// A file for RIB text. It appears under its name when it is complete: until then it has a temporary one.
#pragma once

#include "slvm/support/result.h"

#include <memory>
#include <string>
#include <string_view>

namespace render {

class RibFile {
public:
  /// `gzip`: compressed. The name "-" stands for standard output. The error says why the file cannot be
  /// written.
  static slvm::Result<std::unique_ptr<RibFile>> create(const std::string& name, bool gzip);
  /// Without finish() nothing is left of it.
  ~RibFile();
  RibFile(const RibFile&) = delete;
  RibFile& operator=(const RibFile&) = delete;

  void write(std::string_view text);
  /// Empty, or why the file is not there.
  std::string finish();

private:
  RibFile(std::string name, std::string temporary, void* stream)
      : name_(std::move(name)), temporary_(std::move(temporary)), stream_(stream) {}

  std::string name_, temporary_;
  void* stream_; ///< zlib's
  bool failed_ = false;
};

} // namespace render
