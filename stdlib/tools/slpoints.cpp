// slpoints: clouds of points for subsurface scattering: spread over a mesh by repulsion, or thinned.
#include "slvm/support/files.h"
#include "stdlib/subsurface/grid_points.h"
#include "stdlib/subsurface/ply.h"
#include "stdlib/subsurface/repulsion.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace {

using namespace subsurface;

enum ExitCode { kFine = 0, kFailed = 1, kBadUsage = 2, kMissingFile = 3, kInternal = 4 };

constexpr const char* kFooter = R"(
EXAMPLES
  slpoints head.ply points.ply --freepath 0.4   as many points as light with this mean free path needs
  slpoints points.ply coarse.ply --count 2000   a level of less detail

A file with faces is a mesh: points are spread over it by repulsion, each with the same area. Any other file is a cloud: of it
fewer points are made that stand for the same area and light.
Exit status: 0 fine, 1 the file is wrong, 2 wrong usage, 3 the file is missing.)";

struct Wishes {
  std::string input, output;
  size_t count = 0;
  double free_path = 0;
  RepulsionOptions repulsion;

  size_t points(double area) const { return count ? count : sample_count(area, free_path); }
};

slvm::Result<PointCloud> make(const Wishes& wishes) {
  auto bytes = slvm::read_file(wishes.input, kMostPlyBytes);
  if (!bytes) return slvm::Error{bytes.error()};
  auto file = parse_ply(*bytes, wishes.input);
  if (!file) return slvm::Error{file.error()};
  if (file->find("face")) {
    auto mesh = parse_mesh(*bytes, wishes.input);
    if (!mesh) return slvm::Error{mesh.error()};
    weld(*mesh);
    const MeshPlane plane(*mesh);
    RepulsionOptions options = wishes.repulsion;
    options.points = wishes.points(mesh->total_area());
    return cloud_of(plane, repel(plane, options));
  }
  auto cloud = parse_point_cloud(*bytes, wishes.input);
  if (!cloud) return slvm::Error{cloud.error()};
  if (cloud->area.empty())
    return slvm::Error{fmt::format("{}: there are neither faces nor areas of points", wishes.input)};
  return thin(*cloud, wishes.points(cloud->total_area()));
}

int run(int argc, char** argv) {
  CLI::App app("Points for subsurface scattering: spread over a mesh, or fewer of a cloud.", "slpoints");
  Wishes wishes;
  app.add_option("input", wishes.input, "A PLY file: a mesh or a cloud")->required();
  app.add_option("output", wishes.output, "The PLY file to write")->required();
  auto* count =
      app.add_option("-n,--count", wishes.count, "How many points")->check(CLI::Range(1, 100'000'000));
  app.add_option("--freepath", wishes.free_path,
                 "Or the mean free path 1/sigma_t' of light, of which they follow: area/(pi freepath^2)")
      ->check(CLI::PositiveNumber)
      ->excludes(count);
  app.add_option("--passes", wishes.repulsion.passes, "Of the repulsion (40)")->check(CLI::Range(0, 1000));
  app.add_option("--seed", wishes.repulsion.seed, "Of the places at which points start (0)");
  app.set_version_flag("--version", "slpoints (Anemone) 0.1.0");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
    if (wishes.count == 0 && wishes.free_path == 0) throw CLI::RequiredError("--count or --freepath");
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kBadUsage;
  }
  std::error_code error;
  const bool there = std::filesystem::exists(wishes.input, error);
  const auto cloud = make(wishes);
  std::string problem = cloud ? "" : cloud.error();
  if (cloud)
    if (auto written = write_point_cloud(wishes.output, *cloud); !written) problem = written.error();
  if (problem.empty()) return kFine;
  fmt::print(stderr, "slpoints: error: {}\n", problem);
  return there ? kFailed : kMissingFile;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "slpoints: internal error: {}\n", e.what());
    return kInternal;
  }
}
