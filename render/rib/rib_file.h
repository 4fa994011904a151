// A file for RIB text. It appears under its name when it is complete: until then it has a temporary one.
#pragma once

#include "slvm/support/result.h"
#include "slvm/support/whole_file.h"

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
  RibFile(std::string name, std::unique_ptr<slvm::WholeFile> file, void* stream)
      : name_(std::move(name)), file_(std::move(file)), stream_(stream) {}

  std::string name_;
  std::unique_ptr<slvm::WholeFile> file_; ///< null: standard output
  void* stream_;                          ///< zlib's
  bool failed_ = false;
};

} // namespace render
