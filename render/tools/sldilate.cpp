// sldilate: grows the depths of a mask at its edges.
#include "render/texture/depth_image.h"
#include "render/texture/dilate.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>

namespace {

enum ExitStatus : int { kFine = 0, kFailed = 1, kUsage = 2, kMissingFile = 3 };

int fail(const std::string& file, const std::string& why, ExitStatus status) {
  std::fprintf(stderr, "sldilate: error: %s: %s\n", file.c_str(), why.c_str());
  return status;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("Gives places without depth near the edges of a depth image the depth of the nearest place "
               "that has one, so that "
               "what a blur takes in beyond a translucent object is rendered, too.",
               "sldilate");
  app.set_help_flag("-h,--help", "print this and leave");
  app.set_version_flag("--version", "sldilate 0.1.0 (Anemone)");
  std::string input, output;
  float radius = 0.02f;
  app.add_option("input", input, "a depth image: a Display of type zfile or mode z, or a shadow map")
      ->required();
  app.add_option("output", output, "the file to write; may be the same")->required();
  app.add_option("-r,--radius", radius,
                 "how far, as a part of the width of the picture (0.02); the rad of the blur")
      ->check(CLI::Range(0.0f, 1.0f));
  app.footer(
      "Exit status: 0 fine, 1 the file cannot be read or written, 2 wrong usage, 3 the file is missing.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kUsage;
  }
  std::error_code error;
  if (!std::filesystem::exists(input, error)) return fail(input, "there is no such file", kMissingFile);
  render::DepthImage image;
  if (std::string why = render::read_depth_image(input, image); !why.empty())
    return fail(input, why, kFailed);
  // Other renderers write a large number where there is nothing.
  constexpr float kNothing = 1e29f;
  for (float& z : image.depth)
    if (!(z < kNothing)) z = std::numeric_limits<float>::infinity();
  render::dilate_depths(image.width, image.height, radius * static_cast<float>(image.width), image.depth);
  if (std::string why = render::write_depth_image(output, image); !why.empty())
    return fail(output, why, kFailed);
  return kFine;
}
