// TIFF files from anywhere, as textures: their header, all their levels, and lookups in them.
#include "render/texture/texture_filter.h"
#include "render/texture/texture_tiff.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  namespace fs = std::filesystem;
  static const std::string path =
      (fs::temp_directory_path() / ("fuzz_texture_" + std::to_string(::getpid()))).string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  auto reader = render::open_tiff_texture(path);
  fs::remove(path);
  if (!reader) return 0;
  const auto largest = reader->header().levels[0];
  if (static_cast<int64_t>(largest.width) * largest.height * reader->header().channels > 1 << 22)
    return 0; // slow
  std::atomic<long long> memory{0};
  {
    const render::TextureImage image(std::move(reader), memory);
    slvm::TextureLookup lookup;
    lookup.channels = 3;
    const render::TextureFilter filter(image, lookup, image.header().swrap, image.header().twrap);
    float out[3];
    for (const float side : {0.0f, 0.01f, 0.3f, 5.0f})
      if (!filter.mean({0.3f, 0.8f, side, 0, side, side * 0.1f}, out) && image.problem().empty())
        std::abort();
    for (size_t i = 0; i < image.levels(); ++i)
      if (!image.level(i).texels && image.problem().empty()) std::abort();
  }
  if (memory != 0) std::abort();
  return 0;
}
