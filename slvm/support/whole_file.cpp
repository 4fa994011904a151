// Temporary names, and what is left of them.
#include "slvm/support/whole_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>
#include <unistd.h>

namespace slvm {

namespace {

namespace fs = std::filesystem;

/// Eight digits for this machine and its space of process numbers: containers have spaces of their own, and
/// whether a process lives can be asked in one's own only.
std::string machine() {
  char host[256] = "", space[64] = "";
  ::gethostname(host, sizeof host - 1);
  if (::readlink("/proc/self/ns/pid", space, sizeof space - 1) < 0) space[0] = '\0';
  size_t h = std::hash<std::string>()(fmt::format("{} {}", host, space));
  return fmt::format("{:08x}", static_cast<uint32_t>(h ^ (h >> 32)));
}

/// A process that was killed and that nobody has waited for counts as gone: it writes no more. In containers
/// such processes may stay for ever.
bool is_gone(pid_t process) {
  if (::kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream status(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(status, line);
  // NUMBER (NAME) STATE ..., where the name may hold anything.
  size_t name_end = line.rfind(") ");
  return name_end != line.npos && name_end + 2 < line.size() && line[name_end + 2] == 'Z';
}

/// Whether a file name is that of a temporary file, with this beginning, of a process that is no more.
bool is_left_over(std::string_view name, std::string_view beginning) {
  constexpr std::string_view kEnd = ".part";
  if (!name.starts_with(beginning)) return false;
  name.remove_prefix(beginning.size());
  long process = 0;
  auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
  // The thread follows; libraries may add something of their own behind the end.
  bool ours = error == std::errc() && process > 0 && end != name.data() + name.size() && *end == '-' &&
              name.find(kEnd) != name.npos;
  return ours && is_gone(static_cast<pid_t>(process));
}

void remove_left_overs(const fs::path& folder, const std::string& beginning) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (is_left_over(it->path().filename().string(), beginning) && it->is_regular_file(ignored))
      fs::remove(it->path(), ignored);
  }
}

} // namespace

WholeFile::WholeFile(std::string name) : name_(std::move(name)) {
  std::string beginning = fmt::format("{}.{}-", name_, machine());
  // Threads that write the same file do not meet in the temporary one.
  temporary_ = fmt::format("{}{}-{:x}.part", beginning, ::getpid(),
                           std::hash<std::thread::id>()(std::this_thread::get_id()));
  fs::path path(beginning);
  remove_left_overs(path.has_parent_path() ? path.parent_path() : fs::path("."), path.filename().string());
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!done_) fs::remove(temporary_, ignored);
}

std::string WholeFile::commit() {
  std::error_code error;
  fs::rename(temporary_, name_, error);
  done_ = !error;
  return error ? error.message() : "";
}

std::string write_whole_file(const std::string& name, const void* data, size_t bytes) {
  WholeFile file(name);
  std::ofstream out(file.temporary(), std::ios::binary);
  if (!out) return std::strerror(errno);
  out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  out.close();
  return out ? file.commit() : "the disk is full or gone";
}

} // namespace slvm
