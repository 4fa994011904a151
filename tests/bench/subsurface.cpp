// What lookups of diffusion cost: the tree of Jensen and Buhler beside the sum over all samples, in one run,
// by the number of samples and by epsilon; and by how much they differ. And what it costs to have a cloud
// ready, by where it is kept. One thread. Usage: subsurface_bench [--check]
//
// The samples are those of a ball of white marble, 40 mm across, lit from above.
#include "stdlib/subsurface/lit_cloud.h"
#include "tests/unit/subsurface/surfaces.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace {

using namespace subsurface;

constexpr float kRadius = 20;

/// Seconds of one run of f, the least of a few.
template <class F> double seconds(F&& f, int runs) {
  double best = 1e9;
  for (int i = 0; i < runs; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    f();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

/// Lookups in order over the surface, as grids make them.
struct Scene {
  explicit Scene(size_t samples) : cloud(test::ball(samples, kRadius)), probes(test::ball(400, kRadius)) {
    build_seconds = seconds([&] { tree = *DiffusionTree::build(cloud); }, 1);
  }
  PointCloud cloud, probes;
  DiffusionTree tree;
  double build_seconds = 0;
  DiffusionMaterial marble{dipole_of(medium_of(*find_material("marble")))};
};

struct Row {
  double seconds = 0, rms = 0, terms = 0; // a lookup
};

Row lookups(const Scene& scene, float epsilon, const std::vector<Color>& exact, int runs) {
  std::vector<Color> out(scene.probes.size());
  LookupCount count;
  scene.tree.exitance(scene.marble, scene.probes.position, {epsilon, {}}, out, &count);
  const auto n = static_cast<double>(out.size());
  Row row;
  row.terms = static_cast<double>(count.groups + count.samples) / n;
  for (size_t i = 0; i < exact.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double off = static_cast<double>(out[i][c] / exact[i][c]) - 1;
      row.rms += off * off / (3 * n);
    }
  row.rms = std::sqrt(row.rms);
  row.seconds = seconds(
                    [&] {
                      scene.tree.exitance(scene.marble, scene.probes.position, {epsilon, {}}, out);
                    },
                    runs) /
                n;
  return row;
}

struct Exact {
  std::vector<Color> values;
  double seconds = 0;
};
Exact sum_all(const Scene& scene) {
  Exact e;
  e.values.resize(scene.probes.size());
  e.seconds = seconds(
                  [&] {
                    scene.tree.exitance(scene.marble, scene.probes.position, {0, {}}, e.values);
                  },
                  1) /
              static_cast<double>(scene.probes.size());
  return e;
}

bool check() {
  const Scene scene(20000);
  const Exact exact = sum_all(scene);
  const double loose = lookups(scene, 0.1f, exact.values, 1).rms,
               tight = lookups(scene, 0.01f, exact.values, 1).rms;
  std::printf("20000 samples: rms %.5f at epsilon 0.1, %.5f at 0.01\n", loose, tight);
  return loose < 0.03 && tight < 0.005;
}

void print(size_t samples, const Scene& scene, float epsilon, const Exact& exact) {
  const Row row = lookups(scene, epsilon, exact.values, 5);
  std::printf("%8zu %9.0f %8.3f %11.1f %10.1f %8.0f %7.0f %9.5f\n", samples, scene.build_seconds * 1e3,
              static_cast<double>(epsilon), exact.seconds * 1e6, row.seconds * 1e6,
              exact.seconds / row.seconds, row.terms, row.rms);
}

/// A folder that goes with the program.
struct Folder {
  Folder()
      : path(std::filesystem::temp_directory_path() / ("subsurface_bench_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path;
};

/// What it costs to have a cloud of 150 000 points ready, by where it is kept. False: something failed.
bool print_caches() {
  const Folder folder;
  const std::string file = (folder.path / "lit.ply").string();
  PointCloud cloud = test::ball(150000, kRadius);
  for (Vec3 p : cloud.position)
    cloud.albedo.push_back({0.5f + p.x / (4 * kRadius), 0.5f, 0.3f});
  if (!write_point_cloud(file, cloud)) return false;
  const CloudCache::Settings keep{size_t{1} << 30, (folder.path / "trees").string()};
  bool fine = true;
  auto get = [&](CloudCache& cache) {
    const auto found = cache.get(file);
    fine = fine && found;
    return found ? found->cloud : nullptr;
  };
  auto fresh = [&](const CloudCache::Settings& settings) {
    return seconds(
        [&] {
          CloudCache cache;
          cache.configure(settings);
          get(cache);
        },
        5);
  };
  const double built = fresh({keep.most_bytes, ""});
  fresh(keep); // writes the tree
  const double on_disk = fresh(keep);
  CloudCache cache;
  const auto lit = get(cache);
  if (!lit) return false;
  const double in_memory = seconds([&] { get(cache); }, 20);
  const double material = seconds(
                   [&] {
                     lit->material({1, 2, 3}, 1.3f);
                   },
                   1),
               material_again = seconds(
                   [&] {
                     lit->material({1, 2, 3}, 1.3f);
                   },
                   20);
  std::printf("\n150000 points, ms: PLY read and tree built %.1f, tree from disk %.1f, in memory %.4f; "
              "dipoles of all points %.1f, again %.4f\n",
              built * 1e3, on_disk * 1e3, in_memory * 1e3, material * 1e3, material_again * 1e3);
  return fine;
}

} // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--check") == 0) return check() ? 0 : 1;
  if (argc != 1) {
    std::fputs("usage: subsurface_bench [--check]\n", stderr);
    return 2;
  }
  std::puts(" samples  build ms  epsilon  all, us  lookup, us    ratio   terms  rms error");
  for (size_t samples : {10000u, 40000u, 150000u, 600000u}) {
    const Scene scene(samples);
    print(samples, scene, 0.1f, sum_all(scene));
  }
  const Scene scene(150000);
  const Exact exact = sum_all(scene);
  for (float epsilon : {1.0f, 0.3f, 0.1f, 0.03f, 0.01f})
    print(150000, scene, epsilon, exact);
  return print_caches() ? 0 : 1;
}
