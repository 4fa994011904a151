// slc, the shader compiler: arguments, files, exit codes. Read main() first, at the end.
#include "slc/tools/slc_options.h"

#include "slc/ast/print.h"
#include "slc/compiler.h"
#include "slc/tools/dependency_file.h"
#include "slc/tools/diagnostics_json.h"
#include "slc/tools/explanation.h"
#include "slvm/evaluator.h"
#include "slvm/format/disasm.h"
#include "slvm/format/slo.h"
#include "slvm/ir/print.h"
#include "slvm/plugin/finder.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <iterator>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using slc::ToolOptions;

// Exit codes; the greatest of all files counts.
enum ExitCode { kFine = 0, kBadInput = 1, kBadUsage = 2, kMissingFile = 3, kInternal = 4 };

// Compiles the files of one command line.
class Run {
public:
  explicit Run(const ToolOptions& options)
      : options_(options), compile_(options.compile), plugins_(options.plugin_folders) {
    compile_.plugins = &plugins_;
    compile_.evaluator = evaluator_.get();
  }

  int run();

private:
  std::vector<std::string> input_files();
  int compile_file(const std::string& path);
  int explain(slc::TranslationUnit& unit, const std::string& file);
  int preprocess_only(slvm::FileId file);
  int generate(const slc::CheckedSource& checked, slvm::FileId file, std::vector<std::string>& written);
  int write_dependencies(const std::string& source, const slc::PreprocessedText& text,
                         const std::vector<std::string>& targets);
  int emit(const std::string& path, std::string_view bytes);
  void print_diagnostics();

  const ToolOptions& options_;
  slc::Compiler compiler_;
  std::unique_ptr<slvm::ir::ConstantEvaluator> evaluator_ = slvm::make_kernel_evaluator();
  slc::CompileOptions compile_; // with what the program hands in
  slvm::PluginFinder plugins_;
  slvm::SourceManager sources_; // of the current file
  slvm::Diagnostics diags_;
  int worst_ = kFine;
};

int Run::run() {
  std::vector<std::string> files = input_files();
  std::vector<std::string> failed;
  for (const std::string& file : files) {
    if (options_.verbose) fmt::print(stderr, "slc: {}\n", file);
    int code = compile_file(file);
    worst_ = std::max(worst_, code);
    if (code != kFine) failed.push_back(file);
  }
  if (files.size() > 1 && !failed.empty()) {
    fmt::print(stderr, "slc: {} of {} files failed:\n", failed.size(), files.size());
    for (const std::string& file : failed)
      fmt::print(stderr, "    {}\n", file);
  }
  return worst_;
}

// Folders stand for the .sl files in them, at any depth.
std::vector<std::string> Run::input_files() {
  std::vector<std::string> files;
  for (const std::string& input : options_.inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error)) {
      files.push_back(input);
      continue;
    }
    size_t first = files.size();
    for (auto it = fs::recursive_directory_iterator(input, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error))
      if (it->path().extension() == ".sl" && it->is_regular_file(error)) files.push_back(it->path().string());
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end());
  }
  return files;
}

int Run::compile_file(const std::string& path) {
  bool standard_input = path == "-";
  std::string name = standard_input ? options_.stdin_name : path;
  std::optional<std::string> text;
  if (standard_input)
    text = std::string(std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>());
  else
    text = slc::read_file(path);
  if (!text) {
    fmt::print(stderr, "slc: cannot read '{}'\n", path);
    return kMissingFile;
  }
  sources_ = {};
  diags_ = options_.diagnostics;
  slvm::FileId file = sources_.add(name, std::move(*text));
  if (options_.preprocess_only || options_.dependencies_only) return preprocess_only(file);

  slc::CheckedSource checked = compiler_.check(file, compile_, sources_, diags_);
  int code = diags_.has_errors() ? kBadInput : kFine;
  if (options_.dump == "ast") fmt::print("{}", slc::print_ast(checked.unit));
  std::vector<std::string> written;
  if (!options_.explain.empty()) {
    print_diagnostics();
    return std::max(code, explain(checked.unit, name));
  }
  if (code == kFine && options_.dump != "ast") code = generate(checked, file, written);
  print_diagnostics();
  if (code == kFine && options_.dependencies) code = write_dependencies(name, checked.text, written);
  return code;
}

// Errors do not stand in the way: that a value varies may be one.
int Run::explain(slc::TranslationUnit& unit, const std::string& file) {
  int code = kFine;
  for (const std::string& name : options_.explain) {
    std::string text = slc::explanation(unit, name, sources_);
    if (text.empty()) {
      fmt::print(stderr, "{}", slc::no_such_variable(unit, name, file));
      code = kBadInput;
    }
    fmt::print("{}", text);
  }
  return code;
}

int Run::preprocess_only(slvm::FileId file) {
  slc::PreprocessedText text = compiler_.preprocess(file, options_.compile, sources_, diags_);
  print_diagnostics();
  if (diags_.has_errors()) return kBadInput;
  if (options_.dependencies_only) return write_dependencies(std::string(sources_.name(file)), text, {});
  return emit(options_.output.empty() ? "-" : options_.output, slc::with_line_markers(text, sources_));
}

// Prints what --dump asks for, or writes one .slo for each shader of the file, named after the shader.
int Run::generate(const slc::CheckedSource& checked, slvm::FileId file, std::vector<std::string>& written) {
  std::vector<slc::CompiledShader> shaders = compiler_.generate(checked, file, compile_, sources_);
  if (shaders.size() > 1 && !options_.output.empty() && options_.dump.empty()) {
    fmt::print(stderr, "slc: -o names one file, but '{}' defines {} shaders; use -d\n", sources_.name(file),
               shaders.size());
    return kBadUsage;
  }
  for (const slc::CompiledShader& shader : shaders) {
    if (options_.dump == "ir") fmt::print("{}", slvm::ir::print(shader.module));
    if (options_.dump == "bytecode") fmt::print("{}", slvm::disassemble(shader.program));
    if (!options_.dump.empty()) continue;
    fs::path path = options_.output.empty() ? fs::path(options_.output_dir) / (shader.program.name + ".slo")
                                            : fs::path(options_.output);
    std::vector<std::byte> bytes = slvm::write_slo(shader.program);
    if (int code = emit(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        code != kFine)
      return code;
    written.push_back(path.string());
    if (!options_.quiet && path != "-")
      fmt::print("{} \"{}\" -> {}\n", slvm::shader_kind_name(shader.program.kind), shader.program.name,
                 path.string());
  }
  return kFine;
}

int Run::write_dependencies(const std::string& source, const slc::PreprocessedText& text,
                            const std::vector<std::string>& targets) {
  std::string stem = (fs::path(options_.output_dir) / fs::path(source).stem()).string();
  std::vector<std::string> names = targets;
  if (names.empty())
    names = {options_.output.empty() || options_.dependencies_only ? stem + ".slo" : options_.output};
  std::string path = options_.dependency_file;
  if (path.empty())
    path = options_.dependencies_only ? "-" : fs::path(names.front()).replace_extension(".d").string();
  std::string head = options_.dependency_target.empty() ? slc::make_names(names) : options_.dependency_target;
  return emit(path, slc::dependency_rule(head, source, text.dependencies, options_.system_dependencies));
}

// To a file, or with "-" to standard output.
int Run::emit(const std::string& path, std::string_view bytes) {
  if (path == "-") {
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return kFine;
  }
  slvm::Result<bool> done = slvm::write_file(path, std::as_bytes(std::span(bytes)));
  if (done) return kFine;
  fmt::print(stderr, "slc: {}\n", done.error());
  return kMissingFile;
}

void Run::print_diagnostics() {
  if (options_.json)
    fmt::print(stderr, "{}", slc::diagnostics_json(diags_, sources_));
  else
    fmt::print(stderr, "{}", slvm::format_diagnostics(diags_, sources_, isatty(STDERR_FILENO) != 0));
}

} // namespace

int main(int argc, char** argv) {
  try {
    slc::ToolOptions options;
    if (std::optional<int> code = slc::parse_arguments(argc, argv, options)) return *code;
    return Run(options).run();
  } catch (const std::exception& e) {
    fmt::print(stderr, "slc: internal error: {}\n", e.what());
    return kInternal;
  }
}
