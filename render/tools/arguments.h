// The command line of slrender.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace render::tools {

enum class ProgressStyle : uint8_t { kNone, kUpdating, kLines };

struct Arguments {
  std::vector<std::string> files; ///< "-": standard input
  int threads = 0;                ///< 0: all processors
  ProgressStyle progress = ProgressStyle::kNone;
  std::string progress_format = "R90000 {:3.0f}%";
  std::optional<std::array<float, 4>> crop;
  std::optional<std::array<int, 2>> resolution;
  /// Numbers of the frames that are rendered, from the first to the second of each pair; none: all.
  std::vector<std::array<int, 2>> frames;
  std::string display; ///< a file name or a Display type
  std::string directory;
  std::vector<std::string> shader_path, archive_path;
  std::vector<std::string> procedural_path;
  std::vector<std::string> plugin_folders;     ///< of shaders
  std::vector<std::string> procedural_folders; ///< of procedurals: those of the path that the user gave
  bool allow_programs = false;
  double program_seconds = 60;
  bool statistics = false;
  std::string preview;         ///< a PNG file kept up to date; empty: none
  std::string statistics_file; ///< JSON lines; empty: none
  int verbosity = 1;
  bool warnings_are_errors = false, no_warnings = false;

  /// Set when there is nothing to do but leave: after --help or --version, or with a usage error.
  std::optional<int> exit_status;
};

/// Prints help, version and usage errors itself.
Arguments parse_arguments(int argc, char** argv);

} // namespace render::tools
