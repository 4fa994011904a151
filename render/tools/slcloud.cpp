// slcloud: looks at clouds of points: irradiance caches, photon maps, PLY files.
#include "render/renderer.h"
#include "render/setup/compiling_loader.h"
#include "render/setup/places.h"
#include "render/tools/cloud_view.h"
#include "slvm/support/files.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

enum ExitStatus : int { kFine = 0, kFailed = 1, kUsage = 2, kMissingFile = 3, kInternal = 4 };

constexpr const char* kFooter = R"(
EXAMPLES
  slcloud wall.ocf                                        what is in it
  slcloud hero.icf -o hero.png --turn 30 --tilt 20        a picture, from the right and from above
  slcloud hero.icf -o hero.png --discs --show occlusion   discs that lie on the surface
  slcloud hero.icf -o hero.ply                            for other viewers

Exit status: 0 fine, 1 the file is wrong, 2 wrong usage, 3 the file is missing.)";

int fail(const std::string& why, ExitStatus status) {
  std::fprintf(stderr, "slcloud: error: %s\n", why.c_str());
  return status;
}

/// "" or what went wrong.
std::string render_scene(const std::string& scene) {
  render::RendererSettings settings;
  std::string said;
  settings.shader_loader =
      render::setup::make_compiling_loader("slcloud", [&](std::string_view text) { said += text; });
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  render::Renderer renderer(sources, diagnostics, settings);
  renderer.set_standard_path("shader", render::setup::standard_shader_folders());
  renderer.read_text("slcloud", scene);
  renderer.finish();
  return said + format_diagnostics(diagnostics, sources);
}

std::string write(const render::PointTable& table, const render::tools::ViewSettings& view,
                  const std::string& output) {
  const std::string suffix = std::filesystem::path(output).extension().string();
  if (suffix == ".ply") {
    auto written = subsurface::write_point_cloud(output, render::tools::cloud_of(table));
    return written ? "" : written.error();
  }
  const std::string picture =
      suffix == ".rib" ? std::filesystem::path(output).replace_extension(".png").filename().string() : output;
  auto scene = render::tools::scene_of(table, view, picture);
  if (!scene) return scene.error();
  if (suffix != ".rib") return render_scene(*scene);
  auto written = slvm::write_file(output, std::as_bytes(std::span(*scene)));
  return written ? "" : written.error();
}

int run(int argc, char** argv) {
  CLI::App app("Tells what is in an irradiance cache, a photon map or a PLY file, or shows it in a picture.",
               "slcloud");
  app.set_help_flag("-h,--help", "print this and leave");
  app.set_version_flag("--version", "slcloud 0.1.0 (Anemone)");
  std::string input, output;
  render::tools::ViewSettings view;
  std::vector<int> size;
  app.add_option("input", input, "an irradiance cache (.ocf, .icf), a photon map (.gpm) or a PLY file")
      ->required();
  app.add_option("-o,--output", output,
                 "a picture; or a RIB file (.rib) that renders it, or a PLY file (.ply) of the points");
  app.add_option("--show", view.show,
                 "the column that is shown (of those there are the first of radiance, irradiance, occlusion, "
                 "power, albedo)");
  app.add_flag("--discs", view.discs, "discs that lie on the surface, not points");
  app.add_option("--scale", view.scale, "of points and discs (1)")->check(CLI::PositiveNumber);
  app.add_option("--turn", view.turn, "degrees round the upright axis (0)");
  app.add_option("--tilt", view.tilt, "degrees from above, negative: from below (0)");
  app.add_option("--zoom", view.zoom, "1: all is seen (1)")->check(CLI::PositiveNumber);
  app.add_option("--gain", view.gain, "multiplies what is shown (1)");
  app.add_option("--size", size, "of the picture in pixels (512 512)")
      ->expected(2)
      ->check(CLI::Range(1, 16384));
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kUsage;
  }
  if (size.size() == 2) {
    view.width = size[0];
    view.height = size[1];
  }
  std::error_code error;
  if (!std::filesystem::exists(input, error)) return fail(input + ": there is no such file", kMissingFile);
  auto table = render::tools::read_cloud(input);
  if (!table) return fail(table.error(), kFailed);
  if (output.empty()) {
    std::fputs(render::tools::describe(*table, input).c_str(), stdout);
    return kFine;
  }
  const std::string problem = write(*table, view, output);
  return problem.empty() ? kFine : fail(problem, kFailed);
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "slcloud: internal error: %s\n", e.what());
    return kInternal;
  }
}
