#include "slvm/tools/sltest/obtain.h"

#include <fmt/format.h>

#include <algorithm>

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

} // namespace

ShaderPtr obtain(const Setup& setup, const ShaderRef& ref, std::span<const Formal> formals,
                 ShaderLibrary& library, CompileMode mode, RunError& error) {
  ShaderError why;
  ShaderPtr shader;
  if (ref.form == ShaderForm::kFile) {
    shader = library.find(ref.text, mode, setup.path, why);
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
