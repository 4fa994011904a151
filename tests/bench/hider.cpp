// Micropolygons of about a pixel over a bucket, 2 by 2 samples a pixel: grids that are painted (quad_paint.h)
// beside the same grids hit by hit. --check: the pixels are the same.
#include "render/hider/sample_buffer.h"

#include <benchmark/benchmark.h>

#include <cstring>

namespace {

using namespace render;

constexpr int kPixels = 32, kGrid = 17, kLayers = 4;

/// Slightly turned grids, one behind the other, which cover the bucket together.
std::vector<ShadedGrid> make_grids() {
  std::vector<ShadedGrid> out;
  for (int layer = 0; layer < kLayers; ++layer)
    for (int part = 0; part < 9; ++part) {
      ShadedGrid& g = out.emplace_back();
      g.nu = g.nv = kGrid;
      g.smooth = true;
      g.opaque = true;
      g.hidden.assign((kGrid - 1) * (kGrid - 1), ShadedGrid::kDrawn);
      g.position = g.Ci = Vec3Planes(kGrid * kGrid);
      g.Oi = Vec3Planes(kGrid * kGrid, Color(1.0f));
      for (int k = 0; k < kGrid * kGrid; ++k) {
        const auto point = static_cast<size_t>(k);
        const auto x = static_cast<float>(part % 3 * (kGrid - 1) + k % kGrid - 8),
                   y = static_cast<float>(part / 3 * (kGrid - 1) + k / kGrid - 8);
        g.position.set(point, {x + 0.1f * y, y - 0.1f * x, static_cast<float>(2 + layer)});
        g.Ci.set(point, {x / kPixels, y / kPixels, static_cast<float>(layer) / kLayers});
      }
    }
  return out;
}

struct Bench {
  SamplingSettings settings;
  std::vector<ShadedGrid> grids;
  SampleBuffer buffer;
  Image image{{0, 0, kPixels, kPixels}, 0};

  explicit Bench(const Camera* hit_by_hit)
      : settings(make_settings(hit_by_hit)), grids(make_grids()), buffer(settings) {}
  /// With a clipping plane the hider looks at each hit, even if the plane is behind the eye.
  static SamplingSettings make_settings(const Camera* hit_by_hit) {
    SamplingSettings out;
    out.reconstruction.filter = {FilterKind::kGaussian, 2, 2};
    out.camera = hit_by_hit;
    if (hit_by_hit) out.clipping_planes = {{Vec3(0, 0, -1), Vec3(0, 0, -1)}};
    return out;
  }
  void run() {
    buffer.begin(image.rect);
    for (const ShadedGrid& g : grids)
      buffer.draw(g);
    buffer.finish(image);
  }
};

} // namespace

int main(int argc, char** argv) {
  const Camera camera{Options()};
  Bench painted(nullptr), hit(&camera);
  if (argc > 1 && std::strcmp(argv[1], "--check") == 0) {
    painted.run();
    hit.run();
    return painted.image.data == hit.image.data ? 0 : 1;
  }
  for (auto [name, bench] : {std::pair("painted", &painted), std::pair("hit by hit", &hit)})
    benchmark::RegisterBenchmark(name, [bench = bench](benchmark::State& state) {
      for (auto _ : state)
        bench->run();
      state.counters["ns/micropolygon"] =
          benchmark::Counter(9 * kLayers * (kGrid - 1) * (kGrid - 1) * 1e-9,
                             benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
