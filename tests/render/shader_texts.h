// Shaders of a test, from their texts.
#pragma once

#include "render/shading/shader_loader.h"
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"

#include <map>
#include <string>
#include <vector>

namespace render::testing {

/// Compiles the shader of this name; the error is what the compiler says.
inline slvm::Result<std::string> compile_shader_text(const std::map<std::string, std::string>& texts,
                                                     const std::string& name,
                                                     const std::vector<std::string>& path = {}) {
  auto it = texts.find(name);
  if (it == texts.end()) return no_such_shader(name, path);
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::CompileOptions options;
  auto evaluator = slvm::make_kernel_evaluator();
  options.evaluator = evaluator.get();
  auto out = slc::Compiler().compile(sources.add(name + ".sl", it->second), options, sources, diagnostics);
  if (out.empty()) return slvm::Error{format_diagnostics(diagnostics, sources)};
  auto bytes = slvm::write_slo(out[0].program);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

} // namespace render::testing
