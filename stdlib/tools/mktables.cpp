// mktables: prints tables of samples for the diffusion term of subsurface scattering as RSL arrays.
#include "slvm/support/files.h"
#include "stdlib/subsurface/sample_tables.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>

namespace {

enum ExitCode { kFine = 0, kBadUsage = 2, kMissingFile = 3, kInternal = 4 };

constexpr const char* kFooter = R"(
EXAMPLES
  mktables > scatter.h              128 places, as the arrays scattdiffdist1 (x) and scattdiffdist2 (y)
  mktables -n 64 -t 4 -o scatter.h  four tables of 64, one after another in the arrays

Places are in units of the diffuse mean free path: u = r/l_d is distributed by 1 - exp(-u)(1 + u).)";

int run(int argc, char** argv) {
  CLI::App app("Tables of samples for the diffusion term of subsurface scattering, as RSL arrays.",
               "mktables");
  subsurface::SampleTableOptions options;
  std::string file = "-";
  app.add_option("-n,--samples", options.samples, "Places in a table (128)")->check(CLI::Range(1, 1024));
  app.add_option("-t,--tables", options.tables, "Tables (1)")->check(CLI::Range(1, 64));
  app.add_option("--candidates", options.candidates, "Place i is the best of this many times i (10)")
      ->check(CLI::Range(1, 100));
  app.add_option("--seed", options.seed, "Of the random numbers (0): the same seed, the same tables");
  app.add_option("-o", file, "The file to write; - is standard output")->type_name("FILE");
  app.set_version_flag("--version", "mktables (Anemone) 0.1.0");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kBadUsage;
  }
  const std::string text = subsurface::format_sample_tables(subsurface::make_sample_tables(options), options);
  if (file == "-")
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? kFine : kMissingFile;
  if (auto done = slvm::write_file(file, std::as_bytes(std::span(text))); !done) {
    fmt::print(stderr, "mktables: {}\n", done.error());
    return kMissingFile;
  }
  return kFine;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "mktables: internal error: {}\n", e.what());
    return kInternal;
  }
}
