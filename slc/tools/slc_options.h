// The command line of slc.
#pragma once

#include "slc/compiler.h"

#include <optional>

namespace slc {

struct ToolOptions {
  std::vector<std::string> inputs; ///< files, folders, "-" for standard input
  std::string output;              ///< -o: a file, "-", or "" for names after the shaders
  std::string output_dir;          ///< -d
  std::string stdin_name = "<stdin>";
  CompileOptions compile;
  std::vector<std::string> plugin_folders;        ///< --dso and the environment
  slvm::Diagnostics diagnostics;                  ///< without messages: which warnings are on
  bool preprocess_only = false;                   ///< -E
  bool dependencies_only = false;                 ///< -M, -MM
  bool dependencies = false;                      ///< -MD, -MMD
  bool system_dependencies = true;                ///< not -MM, -MMD
  std::string dependency_file, dependency_target; ///< -MF, -MT
  std::string dump;                               ///< ast, ir, bytecode or ""
  std::vector<std::string> explain;               ///< --explain-varying: names of variables
  bool json = false;                              ///< --diagnostics=json
  bool quiet = false, verbose = false;
};

/// Reads the command line and the environment (SLC_OPTIONS, SLC_INCLUDE). Returns an exit code when there is
/// nothing to compile: after --help, --version, and errors of usage.
std::optional<int> parse_arguments(int argc, char** argv, ToolOptions&);

} // namespace slc
