// Writing with zlib, which also writes plain files.
#include "render/rib/rib_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace render {

namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

} // namespace

slvm::Result<std::unique_ptr<RibFile>> RibFile::create(const std::string& name, bool gzip) {
  const char* mode = gzip ? "wb" : "wbT";
  bool standard = name == "-";
  std::string temporary = standard ? "" : fmt::format("{}.{}.part", name, ::getpid());
  gzFile stream = standard ? gzdopen(::dup(STDOUT_FILENO), mode) : gzopen(temporary.c_str(), mode);
  if (!stream) return slvm::Error{fmt::format("cannot write \"{}\": {}", name, reason())};
  return std::unique_ptr<RibFile>(new RibFile(name, std::move(temporary), stream));
}

RibFile::~RibFile() {
  if (!stream_) return;
  gzclose(static_cast<gzFile>(stream_));
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void RibFile::write(std::string_view text) {
  constexpr size_t kMost = size_t{1} << 30; // zlib counts in unsigned
  while (!text.empty() && !failed_) {
    size_t count = std::min(text.size(), kMost);
    failed_ = gzwrite(static_cast<gzFile>(stream_), text.data(), static_cast<unsigned>(count)) == 0;
    text.remove_prefix(count);
  }
}

std::string RibFile::finish() {
  bool closed = gzclose(static_cast<gzFile>(std::exchange(stream_, nullptr))) == Z_OK;
  std::error_code error;
  std::string why;
  if (failed_ || !closed)
    why = reason();
  else if (!temporary_.empty())
    std::filesystem::rename(temporary_, name_, error);
  if (error) why = error.message();
  if (why.empty()) return {};
  std::filesystem::remove(temporary_, error);
  return fmt::format("cannot write \"{}\": {}", name_, why);
}

} // namespace render
