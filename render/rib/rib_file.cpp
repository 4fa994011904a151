// Writing with zlib, which also writes plain files.
#include "render/rib/rib_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
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
  auto file = name == "-" ? nullptr : std::make_unique<slvm::WholeFile>(name);
  gzFile stream = file ? gzopen(file->temporary().c_str(), mode) : gzdopen(::dup(STDOUT_FILENO), mode);
  if (!stream) return slvm::Error{fmt::format("cannot write \"{}\": {}", name, reason())};
  return std::unique_ptr<RibFile>(new RibFile(name, std::move(file), stream));
}

RibFile::~RibFile() {
  if (stream_) gzclose(static_cast<gzFile>(stream_));
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
  std::string why;
  if (failed_ || !closed)
    why = reason();
  else if (file_)
    why = file_->commit();
  file_.reset();
  return why.empty() ? why : fmt::format("cannot write \"{}\": {}", name_, why);
}

} // namespace render
