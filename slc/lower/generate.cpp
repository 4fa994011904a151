// Code from checked source: lowering, optimisation, emission, and the program's tables.
#include "slc/compiler.h"
#include "slc/lower/lower.h"

#include "slvm/format/slo.h"
#include "slvm/format/verify.h"
#include "slvm/ir/emit.h"
#include "slvm/ir/serialise.h"

#include <cassert>

namespace slc {

namespace {

// The main file and what it includes, as they were read.
std::vector<slvm::SourceFile> input_files(const CheckedSource& checked, slvm::FileId main,
                                          const slvm::SourceManager& sources) {
  auto entry = [&](slvm::FileId id) {
    return slvm::SourceFile{std::string(sources.name(id)),
                            slvm::hash_bytes(std::as_bytes(std::span(sources.text(id))))};
  };
  std::vector<slvm::SourceFile> files = {entry(main)};
  for (const Dependency& d : checked.text.dependencies)
    files.push_back(entry(sources.find(d.path)));
  return files;
}

} // namespace

std::vector<CompiledShader> Compiler::compile(slvm::FileId main, const CompileOptions& options,
                                              slvm::SourceManager& sources, slvm::Diagnostics& diags) const {
  CheckedSource checked = check(main, options, sources, diags);
  if (diags.has_errors()) return {};
  return generate(checked, main, options, sources);
}

std::vector<CompiledShader> Compiler::generate(const CheckedSource& checked, slvm::FileId main,
                                               const CompileOptions& options,
                                               const slvm::SourceManager& sources) const {
  std::vector<std::string> files;
  for (slvm::FileId id = 0; id < sources.count(); ++id)
    files.emplace_back(sources.name(id));
  const std::vector<slvm::SourceFile> inputs = input_files(checked, main, sources);
  std::vector<CompiledShader> out;
  for (const Shader& shader : checked.unit.shaders) {
    CompiledShader& compiled = out.emplace_back();
    std::vector<slvm::SourceCall> calls;
    compiled.module = lower_shader(shader, files, calls);
    slvm::ir::canonicalise(compiled.module);
    slvm::ir::optimise(compiled.module, options.optimise, options.evaluator);
    settle_defaults(compiled.module);
    slvm::ir::infer_detail(compiled.module);
    slvm::Program& p = compiled.program;
    p.kind = shader.kind;
    p.name = shader.name;
    p.source_name = sources.name(main);
    p.source_hash = slvm::hash_bytes(std::as_bytes(std::span(checked.text.text)));
    p.sources = inputs;
    p.compiler = kVersion;
    for (const Annotation& a : shader.annotations)
      p.annotations.push_back({a.id, a.text});
    p.facts = collect_facts(compiled.module, calls);
    p.plugins = compiled.module.plugins; // of which facts.calls speaks
    p.ir = slvm::ir::serialise(compiled.module);
    if (options.optimise >= 2 && slvm::ir::fuse_products(compiled.module))
      slvm::ir::infer_detail(compiled.module);
    slvm::ir::emit(compiled.module, p);
    assert(slvm::verify_program(p).empty());
  }
  return out;
}

} // namespace slc
