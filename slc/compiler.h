// The compiler as a library: source text in, checked shaders out. PUBLIC.
//
//   slvm::SourceManager sources;
//   slvm::Diagnostics diags;
//   slc::Compiler compiler;
//   slc::CheckedSource checked = compiler.check(sources.add("plastic.sl", text), {}, sources, diags);
//   if (diags.has_errors()) std::fputs(slvm::format_diagnostics(diags, sources).c_str(), stderr);
#pragma once

#include "slc/ast/unit.h"
#include "slc/preprocess/preprocess.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/support/diagnostics.h"

namespace slc {

class BuiltinLibrary;

/// What --version prints and compiled shaders remember.
inline constexpr std::string_view kVersion = "slc (Anemone) 0.1.0";

struct CompileOptions {
  /// Include folders, macros, and how files are read.
  PreprocessOptions preprocess;
  /// 0: code as written; 1: folding, copies, common subexpressions, dead code; 2: also code motion.
  int optimise = 2;
  /// Computes calls of constants (slvm/evaluator.h has one that runs the machine's kernels). Null: they stay
  /// calls, and defaults of parameters that are computed stay unknown to introspection.
  const slvm::ir::ConstantEvaluator* evaluator = nullptr;
  /// Where functions of plug-ins are found (slvm/plugin/finder.h). Null: nowhere.
  const slvm::PluginSource* plugins = nullptr;
};

/// A shader, compiled. A source file may define several.
struct CompiledShader {
  slvm::ir::Module module; ///< optimised
  slvm::Program program;   ///< what write_slo() takes
};

/// A source file after all checks. Without errors in the diagnostics, what ast/*.h promises holds for `unit`.
struct CheckedSource {
  PreprocessedText text;
  TranslationUnit unit;
};

/// Holds what all compilations share: the RSL bodies of built-in functions. One compiler serves any number of
/// threads; sources and diagnostics belong to one compilation each.
class Compiler {
public:
  Compiler();

  /// Preprocesses, parses and checks file `main` of `sources`. Included files are added to `sources`.
  CheckedSource check(slvm::FileId main, const CompileOptions&, slvm::SourceManager& sources,
                      slvm::Diagnostics& diags) const;
  /// The whole way. Empty when there are errors, or no shaders.
  std::vector<CompiledShader> compile(slvm::FileId main, const CompileOptions&, slvm::SourceManager& sources,
                                      slvm::Diagnostics& diags) const;
  /// Code for the shaders of a checked source.
  std::vector<CompiledShader> generate(const CheckedSource&, slvm::FileId main, const CompileOptions&,
                                       const slvm::SourceManager& sources) const;
  /// Only the first step.
  PreprocessedText preprocess(slvm::FileId main, const CompileOptions&, slvm::SourceManager& sources,
                              slvm::Diagnostics& diags) const;

private:
  std::shared_ptr<const BuiltinLibrary> builtins_;
  std::string builtins_error_; // our own bug, reported with every compilation; "" if none
};

} // namespace slc
