#include "slvm/tools/sltest/obtain.h"

#include "slvm/format/stale.h"
#include "slvm/support/path_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace slvm::sltest {
namespace {

/// The line of a test file on which a text begins: multi-line strings begin behind their quotes.
uint32_t text_line(const ShaderRef& ref) {
  return std::max(ref.where.line, 1u) + (ref.text.find('\n') != std::string::npos ? 1 : 0);
}

ShaderPtr obtain_expression(const Setup& setup, const ShaderRef& ref, std::span<const Formal> formals,
                            ShaderLibrary& library, CompileMode mode, ShaderError& error) {
  std::vector<Formal> all;
  for (const Setting& s : ref.params) {
    Declaration d = inferred_type(s.value, s.what);
    auto same_name = [&](const Formal& f) { return f.name == d.name; };
    if (std::any_of(formals.begin(), formals.end(), same_name)) continue;
    all.push_back({d.name, *d.type, d.elements, d.detail == Detail::kVarying});
  }
  all.insert(all.end(), formals.begin(), formals.end());
  CodeOptions options;
  if (!ref.where.file.empty()) options.label = ref.where.file;
  options.first_line = ref.where.file.empty() ? 1 : text_line(ref);
  options.first_column = std::max(ref.where.column, 1u);
  options.mode = mode;
  if (ref.result) options.types = {*ref.result};
  options.path = setup.path;
  options.prelude = setup.prelude;
  return compile_code(library, ref.text, all, options, error);
}

/// A file. Where a .slo found by name proves older than its source, the source is taken, as for a shader
/// without .slo; one that was asked for as a file is run as it is.
ShaderPtr obtain_file(const Setup& setup, const std::string& name, ShaderLibrary& library, CompileMode mode,
                      ShaderError& error) {
  ShaderPtr shader = library.find(name, mode, setup.path, error);
  const std::string file = find_shader_file(name, setup.path);
  if (!shader || !file.ends_with(".slo")) return shader;
  std::vector<SourceCheck> sources = check_sources(shader->program, file);
  auto changed = [](const SourceCheck& s) { return s.state == SourceState::kChanged; };
  if (std::none_of(sources.begin(), sources.end(), changed)) return shader;
  ShaderPtr fresh;
  if (!name.ends_with(".slo")) {
    fresh = library.find(std::filesystem::absolute(sources.front().path).string(), mode, setup.path, error);
    if (!fresh) return nullptr;
    if (fresh->program.name != shader->program.name) fresh = nullptr;
  }
  CompiledShader told = fresh ? *fresh : *shader;
  told.warnings.insert(
      0, fmt::format("sltest: warning: {}\n", stale_warning(shader->program, file, fresh != nullptr)));
  return std::make_shared<const CompiledShader>(std::move(told));
}

} // namespace

ShaderPtr obtain(const Setup& setup, const ShaderRef& ref, std::span<const Formal> formals,
                 ShaderLibrary& library, CompileMode mode, RunError& error) {
  ShaderError why;
  ShaderPtr shader;
  if (ref.form == ShaderForm::kFile) {
    shader = obtain_file(setup, ref.text, library, mode, why);
  } else if (ref.form == ShaderForm::kSource) {
    std::string source = fmt::format("#line {} \"{}\"\n", text_line(ref), ref.where.file);
    if (ref.text.find('\n') == std::string::npos) source.append(std::max(ref.where.column, 1u) - 1, ' ');
    source += ref.text;
    shader = library.compile("<source>", source, mode, setup.path, why);
  } else {
    shader = obtain_expression(setup, ref, formals, library, mode, why);
  }
  if (!shader) error = {why.missing ? Failure::kMissing : Failure::kCompile, why.text};
  return shader;
}

} // namespace slvm::sltest
