// write_image() by the module made of image_oiio.cpp, looked for beside this program and where it is
// installed.
#include "slvm/tools/sltest/image.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace slvm::sltest {
namespace {

using WriteImage = bool (*)(const char*, const float*, int, int, int, char*, size_t);

WriteImage load_module() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return nullptr;
  for (const char* place : {"sltest_images.so", "../lib/anemone/sltest_images.so"}) {
    // Never closed: the library behind it has threads of its own.
    if (void* module = dlopen((folder / place).c_str(), RTLD_NOW | RTLD_LOCAL))
      return reinterpret_cast<WriteImage>(dlsym(module, "sltest_write_image"));
  }
  return nullptr;
}

} // namespace

Result<bool> write_image(const std::string& path, const std::vector<float>& pixels, int nu, int nv,
                         int channels) {
  WriteImage write = load_module();
  if (!write)
    return Error{
        fmt::format("{}: without sltest_images.so (OpenImageIO) there are .pfm, .csv and .txt only", path)};
  char error[1024] = "";
  if (write(path.c_str(), pixels.data(), nu, nv, channels, error, sizeof error)) return true;
  return Error{fmt::format("{}: {}", path, error)};
}

} // namespace slvm::sltest
