// The module, and write_image() by it.
#include "slvm/tools/sltest/image.h"
#include "slvm/tools/sltest/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace slvm::sltest {

void* module_function(const char* name) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return nullptr;
  for (const char* place : {"sltest_images.so", "../lib/anemone/sltest_images.so"}) {
    // Never closed: the library behind it has threads of its own.
    if (void* module = dlopen((folder / place).c_str(), RTLD_NOW | RTLD_LOCAL)) return dlsym(module, name);
  }
  return nullptr;
}

Result<bool> write_image(const std::string& path, const std::vector<float>& pixels, int nu, int nv,
                         int channels) {
  using WriteImage = bool (*)(const char*, const float*, int, int, int, char*, size_t);
  auto write = reinterpret_cast<WriteImage>(module_function("sltest_write_image"));
  if (!write)
    return Error{
        fmt::format("{}: without sltest_images.so (OpenImageIO) there are .pfm, .csv and .txt only", path)};
  char error[1024] = "";
  if (write(path.c_str(), pixels.data(), nu, nv, channels, error, sizeof error)) return true;
  return Error{fmt::format("{}: {}", path, error)};
}

} // namespace slvm::sltest
