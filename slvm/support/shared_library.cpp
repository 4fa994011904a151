// dlopen and its relatives.
#include "slvm/support/shared_library.h"

#include "slvm/support/path_list.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <link.h>

namespace slvm {

namespace fs = std::filesystem;

Result<std::shared_ptr<const SharedLibrary>> SharedLibrary::open(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return Error{fmt::format("{}: there is no such file", path)};
  // Without a slash dlopen would search the system's folders.
  const std::string file = path.find('/') == path.npos ? "./" + path : path;
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle) return std::shared_ptr<const SharedLibrary>(new SharedLibrary(path, handle));
  const char* reason = ::dlerror();
  std::string text = reason ? reason : "it cannot be opened";
  if (text.starts_with(file + ": ")) text.erase(0, file.size() + 2);
  if (text.find("undefined symbol") != text.npos)
    text += "; link the library that has it into the plug-in";
  else if (text.find("invalid ELF header") != text.npos || text.find("file too short") != text.npos ||
           text.find("wrong ELF class") != text.npos)
    text += "; it is no shared library for this machine: compile the plug-in again";
  return Error{fmt::format("{}: {}", path, text)};
}

SharedLibrary::~SharedLibrary() {
  ::dlclose(handle_);
}

void* SharedLibrary::symbol(const std::string& name) const {
  // Of the library itself: not of those it was linked with.
  void* address = ::dlsym(handle_, name.c_str());
  Dl_info info;
  void* map_entry = nullptr;
  struct link_map* own = nullptr;
  if (!address || !::dladdr1(address, &info, &map_entry, RTLD_DL_LINKMAP) ||
      ::dlinfo(handle_, RTLD_DI_LINKMAP, &own) != 0)
    return nullptr;
  return map_entry == own ? address : nullptr;
}

size_t SharedLibrary::size_of(const void* symbol) const {
  Dl_info info;
  void* entry = nullptr;
  if (!::dladdr1(const_cast<void*>(symbol), &info, &entry, RTLD_DL_SYMENT) || !entry) return 0;
  return info.dli_saddr == symbol ? static_cast<const ElfW(Sym)*>(entry)->st_size : 0;
}

namespace {

/// Whether a path lies in the folder or farther down; links of both have been followed.
bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

} // namespace

std::string find_library(std::string_view name, std::span<const std::string> folders) {
  std::vector<fs::path> names{fs::path(name)};
  if (names[0].is_absolute()) names.push_back(names[0].filename());
  for (const fs::path& wanted : names) {
    const std::string file = wanted.filename().string();
    if (file.empty()) continue;
    for (const std::string& given : folders)
      for (const std::string& form : {file, file + ".so", "lib" + file + ".so"}) {
        std::error_code error;
        const fs::path folder = fs::canonical(given.empty() ? "." : given, error);
        if (error) continue;
        const fs::path candidate = fs::canonical(folder / wanted.parent_path() / form, error);
        if (!error && fs::is_regular_file(candidate, error) && lies_in(candidate, folder))
          return candidate.string();
      }
  }
  return "";
}

std::vector<std::string> list_libraries(std::span<const std::string> folders) {
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    std::error_code error;
    for (auto it = fs::directory_iterator(folder, error); !error && it != fs::directory_iterator();
         it.increment(error))
      if (it->path().extension() == ".so" && it->is_regular_file(error))
        files.push_back(it->path().lexically_normal().string());
    std::sort(files.begin() + first, files.end());
  }
  return files;
}

std::string standard_plugin_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return "";
  for (const char* place : {"../lib/anemone/dso", "../dso"})
    if (fs::is_directory(program / place, error))
      return fs::weakly_canonical(program / place, error).string();
  return "";
}

std::vector<std::string> plugin_folders(std::string_view text) {
  std::vector<std::string> folders = split_path_list(text);
  if (const char* more = std::getenv(kPluginFoldersVariable))
    for (std::string& folder : split_path_list(more))
      folders.push_back(std::move(folder));
  if (std::string standard = standard_plugin_folder(); !standard.empty())
    folders.push_back(std::move(standard));
  return folders;
}

std::string plugin_folders_advice(std::span<const std::string> all) {
  std::vector<std::string> folders(all.begin(), all.end());
  std::erase(folders, standard_plugin_folder());
  if (folders.empty())
    return fmt::format(
        "plug-ins are native code, and only those are used that lie in folders given with {} or in {}",
        kPluginFoldersSwitch, kPluginFoldersVariable);
  return fmt::format("searched in {}; {} adds folders", fmt::join(folders, ", "), kPluginFoldersSwitch);
}

} // namespace slvm
