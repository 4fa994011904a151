// TIFF and PNG files from anywhere, as textures: their header, all their levels, and lookups in them.
#include "render/texture/texture_filter.h"
#include "render/texture/texture_png.h"
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
  struct Remove {
    ~Remove() { fs::remove(path); }
  } remove;
  auto reader = render::open_tiff_texture(path);
  if (!reader) reader = render::open_png_texture(path);
  if (!reader) return 0;
  const auto largest = reader->header().levels[0];
  if (static_cast<int64_t>(largest.width) * largest.height * reader->header().channels > 1 << 22)
    return 0; // slow
  std::atomic<long long> memory{0};
  {
    const render::TextureImage image(std::move(reader), memory);
    slvm::TextureLookup lookup;
    lookup.channels = 3;
    render::TextureFilter filter(image, lookup, image.header().swrap, image.header().twrap);
    render::TextureRegions regions;
    render::TextureFilter::Means out;
    constexpr float kSides[] = {0.0f, 0.01f, 0.3f, 5.0f};
    for (size_t i = 0; i < std::size(kSides); ++i) {
      regions.s[i] = 0.3f;
      regions.t[i] = 0.8f;
      regions.s_u[i] = regions.s_v[i] = kSides[i];
      regions.t_v[i] = kSides[i] * 0.1f;
    }
    if (!filter.means(regions, 0xf, out) && image.problem().empty()) std::abort();
    for (size_t i = 0; i < image.levels(); ++i)
      if (!image.level(i).texels && image.problem().empty()) std::abort();
  }
  if (memory != 0) std::abort();
  return 0;
}
