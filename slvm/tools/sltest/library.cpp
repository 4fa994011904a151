#include "slvm/tools/sltest/library.h"

#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/plugin/finder.h"
#include "slvm/support/path_list.h"
#include "slvm/tools/sltest/instrument.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace slvm::sltest {

namespace fs = std::filesystem;

/// The compiler and the kernels it folds constants with.
struct ShaderLibrary::Tools {
  slc::Compiler compiler;
  std::unique_ptr<ir::ConstantEvaluator> evaluator = make_kernel_evaluator();
  PluginFinder plugins;
  explicit Tools(std::vector<std::string> plugin_folders) : plugins(std::move(plugin_folders)) {}
};

ShaderLibrary::ShaderLibrary(std::vector<std::string> plugin_folders)
    : tools_(std::make_unique<Tools>(std::move(plugin_folders))) {}
ShaderLibrary::~ShaderLibrary() = default;

ShaderPtr ShaderLibrary::compile(const std::string& name, const std::string& source, CompileMode mode,
                                 std::span<const std::string> path, ShaderError& error) {
  ShaderPtr& shader = shaders_[fmt::format("{} {}\n{}\n{}", mode.opt_level,
                                           mode.instrumenter ? mode.instrumenter->id() : 0, name, source)];
  if (shader) return shader;

  SourceManager sources;
  Diagnostics diags;
  const FileId main = sources.add(name, source);
  for (const auto& [file, text] : texts_)
    sources.add(file, text);
  slc::CompileOptions options;
  options.optimise = mode.opt_level;
  options.evaluator = tools_->evaluator.get();
  options.plugins = &tools_->plugins;
  options.preprocess.include_dirs.assign(path.begin(), path.end());
  slc::CheckedSource checked = tools_->compiler.check(main, options, sources, diags);
  std::vector<slc::CompiledShader> compiled;
  if (!diags.has_errors()) {
    if (mode.instrumenter) mode.instrumenter->instrument(checked, sources);
    compiled = tools_->compiler.generate(checked, main, options, sources);
  }
  std::string messages = format_diagnostics(diags, sources);
  if (diags.has_errors() || compiled.empty()) {
    error = {false,
             diags.has_errors() ? messages : fmt::format("{}: there is no shader in this file\n", name)};
    return nullptr;
  }
  const std::string stem = fs::path(name).stem().string();
  auto same = std::find_if(compiled.begin(), compiled.end(),
                           [&](const slc::CompiledShader& s) { return s.program.name == stem; });
  Program& program = (same == compiled.end() ? compiled.front() : *same).program;
  std::vector<std::byte> slo = write_slo(program);
  std::vector<std::string> warnings;
  for (const Diagnostic& d : diags.sorted())
    warnings.push_back(
        fmt::format("{}:{}: {} [-W{}]", sources.name(d.where.file), d.where.line, d.text, d.warning_name));
  shader = std::make_shared<const CompiledShader>(
      CompiledShader{std::move(slo), std::move(program), messages, std::move(warnings)});
  return shader;
}

ShaderPtr ShaderLibrary::load(const std::string& file, ShaderError& error) {
  auto bytes = read_file(file);
  if (!bytes) {
    error = {true, bytes.error()};
    return nullptr;
  }
  auto program = read_slo(*bytes);
  if (!program) {
    error = {false, fmt::format("{}: {}", file, program.error())};
    return nullptr;
  }
  return std::make_shared<const CompiledShader>(
      CompiledShader{std::move(*bytes), std::move(*program), "", {}});
}

ShaderPtr ShaderLibrary::find(const std::string& name, CompileMode mode, std::span<const std::string> path,
                              ShaderError& error) {
  const std::string file = find_shader_file(name, path);
  if (file.empty()) {
    error = {true, fmt::format("no shader '{}' in {}", name, fmt::join(path, ":"))};
    return nullptr;
  }
  if (!file.ends_with(".sl")) return load(file, error);
  auto bytes = read_file(file);
  if (!bytes) {
    error = {true, bytes.error()};
    return nullptr;
  }
  std::string source(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return compile(file, source, mode, path, error);
}

} // namespace slvm::sltest
