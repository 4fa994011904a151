// Reading and writing whole files.
#include "slvm/support/files.h"

#include "slvm/support/whole_file.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

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
  std::string why = write_whole_file(path, bytes.data(), bytes.size());
  if (!why.empty()) return Error{fmt::format("cannot write '{}': {}", path, why)};
  return true;
}

} // namespace slvm
