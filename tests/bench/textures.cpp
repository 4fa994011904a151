// Lookups in textures beside OpenImageIO's texture system, in the same file at the same regions.
//
//   textures_bench            times; textures_bench --check compares means only
#include "render/texture/texture_lookups.h"
#include "tests/bench/scratch_file.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/texture.h>
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

namespace {

constexpr size_t kPoints = 4096;

/// Waves of a few texels, 1024 x 1024 of 8 bits.
std::string make_image(const std::string& path) {
  constexpr int kSize = 1024;
  OIIO::ImageBuf image(OIIO::ImageSpec(kSize, kSize, 3, OIIO::TypeDesc::UINT8));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const float wave = std::sin(static_cast<float>(x) * 0.2f) * std::cos(static_cast<float>(y) * 0.13f);
      const float texel[3] = {0.5f + 0.5f * wave, static_cast<float>(x) / kSize,
                              static_cast<float>(y) / kSize};
      image.setpixel(x, y, texel);
    }
  image.write(path);
  return path;
}

/// Regions of 1 to 20 texels, some long and some round, inside the image.
struct Regions {
  slvm::TextureLookup lookup;
  std::vector<uint64_t> mask = std::vector<uint64_t>(kPoints / 64, ~uint64_t{0});
  std::vector<float> result[3];

  explicit Regions(const std::string& map) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(0.1f, 0.9f), side(1 / 1024.0f, 20 / 1024.0f), angle(0, 6.28f);
    lookup.map = map;
    lookup.channels = 3;
    lookup.points = kPoints;
    lookup.mask = mask.data();
    for (size_t i = 0; i < kPoints; ++i) {
      const float a = angle(random), u = side(random), v = side(random);
      const float values[6] = {place(random),   place(random),    u * std::cos(a),
                               u * std::sin(a), -v * std::sin(a), v * std::cos(a)};
      for (size_t c = 0; c < 2; ++c) {
        lookup.centre[c].push_back(values[c]);
        lookup.along_u[c].push_back(values[2 + c]);
        lookup.along_v[c].push_back(values[4 + c]);
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      result[c].resize(kPoints);
      lookup.result[c] = result[c].data();
    }
  }
};

void look_up_by_oiio(OIIO::TextureSystem& system, Regions& r) {
  auto* thread = system.get_perthread_info();
  auto* map = system.get_texture_handle(OIIO::ustring(r.lookup.map), thread);
  const slvm::TextureLookup& l = r.lookup;
  for (size_t i = 0; i < kPoints; ++i) {
    OIIO::TextureOpt o;
    o.interpmode = OIIO::TextureOpt::InterpBilinear;
    o.mipmode = OIIO::TextureOpt::MipModeAniso;
    o.anisotropic = 16;
    float out[3];
    system.texture(map, thread, o, l.centre[0][i], l.centre[1][i], l.along_u[0][i], l.along_u[1][i],
                   l.along_v[0][i], l.along_v[1][i], 3, out);
    for (size_t c = 0; c < 3; ++c)
      r.result[c][i] = out[c];
  }
}

struct Bench {
  bench::ScratchFile file{"textures_bench.tif"};
  std::string path = make_image(file.path());
  Regions regions{path};
  render::TextureLookups lookups{1024};
  OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);

  Bench() {
    system->attribute("automip", 1);
    system->attribute("autotile", 64);
  }
  void own() { lookups.texture(path, regions.lookup); }
  void oiio() { look_up_by_oiio(*system, regions); }
};

/// Both are means over the same regions by other weights: they agree roughly.
int check(Bench& bench) {
  bench.own();
  std::vector<float> own[3] = {bench.regions.result[0], bench.regions.result[1], bench.regions.result[2]};
  bench.oiio();
  double squares = 0;
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < kPoints; ++i)
      squares += std::pow(static_cast<double>(own[c][i] - bench.regions.result[c][i]), 2);
  const double rms = std::sqrt(squares / (3 * kPoints));
  std::printf("RMS difference from OpenImageIO: %.4f\n", rms);
  return rms < 0.05 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
  Bench bench;
  if (argc > 1 && std::strcmp(argv[1], "--check") == 0) return check(bench);
  auto run = [](auto&& look_up) {
    return [look_up](benchmark::State& state) {
      for (auto _ : state)
        look_up();
      state.counters["ns/lookup"] = benchmark::Counter(
          kPoints * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    };
  };
  benchmark::RegisterBenchmark("own", run([&] { bench.own(); }));
  benchmark::RegisterBenchmark("OpenImageIO", run([&] { bench.oiio(); }));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
