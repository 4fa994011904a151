// slfragment: lays the faces of a subdivision mesh out on the unit square, for scatter maps. As a filter for
// one file, or as the program of Procedural "RunProgram".
#include "render/rib/parser.h"
#include "render/rib/rib_file.h"
#include "render/rib/writer.h"
#include "render/state/fragment.h"
#include "render/state/search_path.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <string>

namespace {

enum ExitStatus : int { kFine = 0, kFailed = 1, kUsage = 2, kMissingFile = 3 };

/// Writes the pieces as RIB. The status says how it went; messages go to stderr.
ExitStatus fragment(render::FragmentSource source, const std::function<void(std::string_view)>& write) {
  const std::string name = source.file.empty() ? "<data>" : source.file;
  if (!source.file.empty()) {
    auto text = render::read_file(source.file);
    if (!text) {
      fmt::print(stderr, "slfragment: error: {}: it cannot be read\n", source.file);
      return kMissingFile;
    }
    source.text = std::move(*text);
  }
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  render::RibWriter writer(write);
  render::Fragmenter fragmenter(writer, diagnostics, {}, source.mesh);
  const slvm::FileId file = sources.add(name, std::move(source.text));
  render::parse_rib(sources.text(file), file, fragmenter, diagnostics);
  fmt::print(stderr, "{}", format_diagnostics(diagnostics, sources));
  if (diagnostics.error_count() > 0) return kFailed;
  if (fragmenter.meshes() > source.mesh) return kFine;
  fmt::print(stderr, "slfragment: error: {}: mesh {} is wanted, but there are {} SubdivisionMesh requests\n",
             name, source.mesh, fragmenter.meshes());
  return kFailed;
}

void write_out(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// Lines "detail data", each answered with RIB and the byte 0377. What went wrong is told; the pieces are
/// missing then.
ExitStatus answer() {
  for (std::string line; std::getline(std::cin, line);) {
    const size_t blank = line.find(' ');
    fragment(render::fragment_source(blank == line.npos ? "" : line.substr(blank + 1)), write_out);
    std::fputc(0377, stdout);
    std::fflush(stdout);
  }
  return kFine;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("Lays the faces of a subdivision mesh out on the unit square, each a mesh of its own with the "
               "faces around "
               "it as holes, and the mesh's own points as \"vertex point ScatterPref\": with \"NDC\" as "
               "object space they fill "
               "a picture, which makes a scatter map.",
               "slfragment");
  app.set_help_flag("-h,--help", "print this and leave");
  app.set_version_flag("--version", "slfragment 0.1.0 (Anemone)");
  std::string input, output = "-";
  int mesh = 0;
  app.add_option("input", input,
                 "a RIB file; without one the program answers Procedural \"RunProgram\", whose data is a "
                 "file and, behind a "
                 "blank, the number of a mesh in it (0), or the SubdivisionMesh request itself");
  app.add_option("-o,--output", output, "the RIB file to write (standard output)");
  app.add_option("-n,--mesh", mesh, "which SubdivisionMesh of the file, from 0")
      ->check(CLI::NonNegativeNumber);
  app.footer(
      "Exit status: 0 fine, 1 the mesh is wrong or there is none, 2 wrong usage, 3 the file is missing.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kUsage;
  }
  if (input.empty()) return answer();
  auto file = render::RibFile::create(output, false);
  if (!file) {
    fmt::print(stderr, "slfragment: error: {}\n", file.error());
    return kFailed;
  }
  const ExitStatus status = fragment({input, "", mesh}, [&](std::string_view text) { (*file)->write(text); });
  if (status != kFine) return status;
  if (std::string why = (*file)->finish(); !why.empty()) {
    fmt::print(stderr, "slfragment: error: {}\n", why);
    return kFailed;
  }
  return kFine;
}
