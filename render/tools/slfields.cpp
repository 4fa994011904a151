// slfields: writes into the meshes of a RIB file how far each vertex is from the base and from the tips.
#include "render/rib/gzip.h"
#include "render/rib/parser.h"
#include "render/rib/rib_file.h"
#include "render/rib/writer.h"
#include "render/tools/mesh_fields.h"
#include "slvm/support/files.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace {

enum ExitStatus : int { kFine = 0, kFailed = 1, kUsage = 2, kMissingFile = 3 };

int fail(const std::string& what, const std::string& why, ExitStatus status) {
  std::fprintf(stderr, "slfields: error: %s: %s\n", what.c_str(), why.c_str());
  return status;
}

constexpr size_t kMostText = size_t{1} << 32;

/// The text of a RIB file, unpacked.
slvm::Result<std::string> read_text(const std::string& file) {
  auto bytes = slvm::read_file(file);
  if (!bytes) return slvm::Error{bytes.error()};
  std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (!render::is_gzip(text)) return text;
  render::Unpacked unpacked = render::unpack_gzip(text, kMostText);
  if (!unpacked.error.empty()) return slvm::Error{unpacked.error};
  return std::move(unpacked.text);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes into each mesh of a RIB file how far its vertices are from its base and from its "
               "tips: primitive "
               "variables basedistance and tipdistance, 0 there and 1 at the farthest vertex.",
               "slfields");
  app.set_help_flag("-h,--help", "print this and leave");
  app.set_version_flag("--version", "slfields 0.1.0 (Anemone)");
  std::string input, output, base = "low:y:0.02", tips = "ends";
  render::tools::FieldSettings settings;
  bool by_length = false;
  app.add_option("input", input, "a RIB file with SubdivisionMesh or PointsPolygons")->required();
  app.add_option("output", output, "the RIB file to write; - for standard output; packed if it ends in .gz")
      ->required();
  app.add_option("--base", base,
                 "vertices of the base: numbers (3,17), or low:AXIS:PART, high:AXIS:PART: those in this part "
                 "of the mesh "
                 "along x, y or z (low:y:0.02)");
  app.add_option(
      "--tips", tips,
      "vertices of the tips, likewise; ends: those farther from the base than all around them (ends)");
  app.add_flag("--length", by_length, "count lengths of edges, not their number");
  app.add_option("--basename", settings.base_name, "name of the field from the base (basedistance)");
  app.add_option("--tipname", settings.tip_name, "name of the field from the tips (tipdistance)");
  app.footer("Exit status: 0 fine, 1 errors in the file, 2 wrong usage, 3 the file is missing.");
  try {
    app.parse(argc, argv);
    auto choose = [](const char* option, const std::string& text, render::tools::VertexChoice& choice) {
      auto parsed = render::tools::VertexChoice::parse(text);
      if (!parsed) throw CLI::ValidationError(option, parsed.error());
      choice = *parsed;
    };
    choose("--base", base, settings.base);
    choose("--tips", tips, settings.tips);
    if (settings.base.is_ends())
      throw CLI::ValidationError("--base", "ends are found by their distance from the base");
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kUsage;
  }
  if (by_length) settings.distance = render::tools::Distance::kLength;
  std::error_code error;
  if (!std::filesystem::exists(input, error)) return fail(input, "there is no such file", kMissingFile);
  auto text = read_text(input);
  if (!text) return fail(input, text.error(), kFailed);
  auto file = render::RibFile::create(output, output.ends_with(".gz"));
  if (!file) return fail(output, file.error(), kFailed);

  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  render::RibWriter writer([&](std::string_view piece) { (*file)->write(piece); });
  render::tools::MeshFields fields(writer, settings, diagnostics);
  render::parse_rib(*text, sources.add(input, *text), fields, diagnostics);
  std::string messages = format_diagnostics(diagnostics, sources, ::isatty(STDERR_FILENO) != 0);
  std::fputs(messages.c_str(), stderr);
  if (diagnostics.has_errors()) return kFailed;
  if (fields.count() == 0)
    return fail(input, "there is no mesh in it: SubdivisionMesh or PointsPolygons", kFailed);
  if (std::string why = (*file)->finish(); !why.empty()) return fail(output, why, kFailed);
  return kFine;
}
