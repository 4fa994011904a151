// Modules, and image files by one of them.
#include "slvm/tools/sltest/image.h"
#include "slvm/tools/sltest/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace slvm::sltest {

void* module_function(const char* name, const char* module) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return nullptr;
  for (const char* place : {"", "../lib/anemone"}) {
    // Never closed: the libraries behind it have threads of their own.
    if (void* found = dlopen((folder / place / module).c_str(), RTLD_NOW | RTLD_LOCAL))
      return dlsym(found, name);
  }
  return nullptr;
}

namespace {

Error no_module(const std::string& path, std::string_view what) {
  return Error{fmt::format("{}: without sltest_images.so (OpenImageIO) {}", path, what)};
}

} // namespace

Result<bool> write_image(const std::string& path, const std::vector<float>& pixels, int nu, int nv,
                         int channels, PixelSize size) {
  using WriteImage = bool (*)(const char*, const char*, const float*, int, int, int, bool, char*, size_t);
  auto write = reinterpret_cast<WriteImage>(module_function("sltest_write_image"));
  if (!write) return no_module(path, "there are .pfm, .csv and .txt only");
  namespace fs = std::filesystem;
  fs::path temporary = path;
  temporary.replace_filename(
      fmt::format(".{}.tmp{}", fs::path(path).stem().string(), fs::path(path).extension().string()));
  char error[1024] = "";
  if (!write(path.c_str(), temporary.c_str(), pixels.data(), nu, nv, channels, size == PixelSize::kSmall,
             error, sizeof error))
    return Error{fmt::format("{}: {}", path, error)};
  std::error_code failure;
  fs::rename(temporary, path, failure);
  if (failure) return Error{fmt::format("{}: {}", path, failure.message())};
  return true;
}

Result<Image> read_image(const std::string& path, const std::vector<float>& others) {
  using ReadImage = bool (*)(const char*, int*, float*, size_t, float*, size_t, char*, size_t);
  auto read = reinterpret_cast<ReadImage>(module_function("sltest_read_image"));
  if (!read) return no_module(path, "no image can be read");
  Image image;
  image.rounded = others;
  int shape[3] = {};
  char error[1024] = "";
  // First its size, then the pixels.
  for (int step = 0; step < 2; ++step) {
    if (!read(path.c_str(), shape, image.pixels.data(), image.pixels.size(), image.rounded.data(),
              step ? image.rounded.size() : 0, error, sizeof error))
      return Error{fmt::format("{}: {}", path, error)};
    image.pixels.resize(static_cast<size_t>(shape[0]) * static_cast<size_t>(shape[1]) *
                        static_cast<size_t>(shape[2]));
  }
  image.nu = shape[0];
  image.nv = shape[1];
  image.channels = shape[2];
  return image;
}

} // namespace slvm::sltest
