#include "slvm/support/files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <thread>
#include <unistd.h>

namespace slvm {

Result<std::vector<std::byte>> read_file(const std::string& path, size_t most) {
  std::error_code ec;
  auto size = std::filesystem::file_size(path, ec);
  if (ec) return Error{fmt::format("cannot open '{}': {}", path, ec.message())};
  if (size > most) return Error{fmt::format("'{}' is larger than {} MB", path, most >> 20)};
  std::ifstream in(path, std::ios::binary);
  std::vector<std::byte> bytes(size);
  if (!in || !in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    return Error{fmt::format("cannot read '{}'", path)};
  return bytes;
}

Result<bool> write_file(const std::string& path, std::span<const std::byte> bytes) {
  // Processes and threads that write the same file do not meet in the temporary one.
  const size_t thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
  const std::string temporary = fmt::format("{}.tmp{}-{:x}", path, ::getpid(), thread);
  std::ofstream out(temporary, std::ios::binary);
  if (!out) return Error{fmt::format("cannot write '{}': {}", path, std::strerror(errno))};
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code ec;
  if (out) std::filesystem::rename(temporary, path, ec);
  if (!out || ec) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return Error{fmt::format("cannot write '{}': {}", path, ec ? ec.message() : "the disk is full or gone")};
  }
  return true;
}

} // namespace slvm
