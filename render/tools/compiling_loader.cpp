// Compiling shaders on the fly.
#include "render/tools/compiling_loader.h"

#include "render/state/search_path.h"
#include "render/tools/places.h"
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

namespace render::tools {

namespace {

namespace fs = std::filesystem;

class CompilingLoader {
public:
  explicit CompilingLoader(std::function<void(std::string_view)> show) : show_(std::move(show)) {}

  slvm::Result<std::string> load(const std::string& name, const std::vector<std::string>& path);

private:
  slvm::Result<std::string> compile(const std::string& file, const std::string& name,
                                    const std::vector<std::string>& path);

  std::function<void(std::string_view)> show_;
  // Made when the first source is met: most runs have compiled shaders only.
  std::unique_ptr<slc::Compiler> compiler_;
  std::unique_ptr<slvm::ir::ConstantEvaluator> evaluator_;
};

/// Whether a source stands beside a compiled shader and was changed after it.
bool is_stale(const std::string& compiled, const fs::path& source) {
  std::error_code error;
  auto changed = fs::last_write_time(source, error);
  if (error) return false;
  auto made = fs::last_write_time(compiled, error);
  return !error && changed > made;
}

slvm::Result<std::string> CompilingLoader::load(const std::string& name,
                                                const std::vector<std::string>& path) {
  if (name.ends_with(".slo")) return load_compiled_shader(name, path);
  auto compiled = find_file(name + ".slo", path);
  if (compiled) {
    fs::path source = fs::path(*compiled).replace_extension(".sl");
    if (is_stale(*compiled, source)) return compile(source.string(), name, path);
    return load_compiled_shader(name, path);
  }
  if (auto source = find_file(name + ".sl", path)) return compile(*source, name, path);
  return no_such_shader(name, path);
}

slvm::Result<std::string> CompilingLoader::compile(const std::string& file, const std::string& name,
                                                   const std::vector<std::string>& path) {
  auto text = read_file(file);
  if (!text) return slvm::Error{fmt::format("cannot read \"{}\"", file)};
  if (!compiler_) {
    compiler_ = std::make_unique<slc::Compiler>();
    evaluator_ = slvm::make_kernel_evaluator();
  }
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::CompileOptions options;
  options.preprocess.include_dirs = path;
  if (const char* folders = std::getenv("SLC_INCLUDE"))
    for (std::string& folder : parse_search_path(folders, {}, {}))
      options.preprocess.include_dirs.push_back(std::move(folder));
  options.evaluator = evaluator_.get();
  auto shaders = compiler_->compile(sources.add(file, std::move(*text)), options, sources, diagnostics);
  std::string messages = format_diagnostics(diagnostics, sources);
  if (!messages.empty()) show_(messages);
  if (diagnostics.has_errors()) return slvm::Error{fmt::format("\"{}\" does not compile", file)};
  for (const slc::CompiledShader& shader : shaders) {
    if (shader.program.name != name) continue;
    std::vector<std::byte> bytes = slvm::write_slo(shader.program);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return slvm::Error{fmt::format("\"{}\" defines no shader \"{}\"", file, name)};
}

} // namespace

ShaderLoader make_compiling_loader(std::function<void(std::string_view)> show) {
  auto loader = std::make_shared<CompilingLoader>(std::move(show));
  return [loader](const std::string& name, const std::vector<std::string>& path) {
    return loader->load(name, path);
  };
}

} // namespace render::tools
