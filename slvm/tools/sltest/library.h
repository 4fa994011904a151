// Shaders by name: finds .slo and .sl files, compiles sources in memory through slc, and remembers what it
// made. The only part of sltest that knows the compiler.
#pragma once

#include "slvm/format/program.h"
#include "slvm/support/result.h"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slvm::sltest {

/// A compiled shader: as a file, to be loaded by any Machine, and as data.
struct CompiledShader {
  std::vector<std::byte> slo;
  Program program;
  std::string warnings;                   ///< what the compiler said, as text for a terminal
  std::vector<std::string> warning_texts; ///< each by itself: "file.sl:3: text [-Wname]"
};
using ShaderPtr = std::shared_ptr<const CompiledShader>;

/// Why there is no shader: the file is missing, or it is wrong.
struct ShaderError {
  bool missing = false;
  std::string text;
};

class Instrumenter;

/// How sources are compiled: the optimisation level, and who marks the program before (instrument.h), or
/// null.
struct CompileMode {
  int opt_level = 2;
  Instrumenter* instrumenter = nullptr;
};

class ShaderLibrary {
public:
  /// `plugin_folders`: of plug-ins whose functions sources may call.
  explicit ShaderLibrary(std::vector<std::string> plugin_folders = {});
  ~ShaderLibrary();

  /// Makes the text of a file known, so that messages about code that stands in it can show its lines.
  void add_source(const std::string& name, const std::string& text) { texts_[name] = text; }

  /// Compiles the first shader of `source`. `name` stands for the source in messages.
  ShaderPtr compile(const std::string& name, const std::string& source, CompileMode mode,
                    std::span<const std::string> path, ShaderError& error);

  /// The shader `name`: a path with .sl or .slo, or a bare name that is searched for, NAME.slo before
  /// NAME.sl, in the folders of `path`. Of a source with several shaders the one named like the file is
  /// taken, or else the first.
  ShaderPtr find(const std::string& name, CompileMode mode, std::span<const std::string> path,
                 ShaderError& error);

  /// Everything is compiled or read anew from now on.
  void forget() { shaders_.clear(); }

private:
  ShaderPtr load(const std::string& file, ShaderError& error);

  struct Tools;
  std::unique_ptr<Tools> tools_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, ShaderPtr> shaders_; ///< by level, name and source
};

} // namespace slvm::sltest
