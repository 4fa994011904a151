#include "slvm/support/own_module.h"

#include <dlfcn.h>

#include <filesystem>

namespace slvm {

void* find_in_module(const std::string& name, const char* entry, const std::string& without,
                     std::string& problem) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  problem = without;
  for (const fs::path& place : {folder, folder / "../lib/anemone", fs::path(INSTALLED_MODULES)}) {
    const fs::path file = place / (name + ".so");
    if (!fs::exists(file, error)) continue;
    void* handle = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (void* found = handle ? ::dlsym(handle, entry) : nullptr) {
      problem.clear();
      return found;
    }
    const char* why = ::dlerror();
    problem = file.string() + " cannot be loaded: " + (why ? why : "unknown reason");
  }
  return nullptr;
}

} // namespace slvm
