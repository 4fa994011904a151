// A file for the time of a benchmark.
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace bench {

class ScratchFile {
public:
  explicit ScratchFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_" + name)) {}
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

} // namespace bench
