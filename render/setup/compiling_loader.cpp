// Compiling shaders on the fly.
#include "render/setup/compiling_loader.h"

#include "render/setup/places.h"
#include "render/state/search_path.h"
#include "slc/compiler.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/format/stale.h"
#include "slvm/plugin/finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>

namespace render::setup {

namespace {

class CompilingLoader {
public:
  CompilingLoader(std::string program, std::function<void(std::string_view)> show,
                  std::vector<std::string> plugin_folders)
      : program_(std::move(program)), show_(std::move(show)), plugins_(std::move(plugin_folders)) {}

  slvm::Result<std::string> load(const std::string& name, const std::vector<std::string>& path);

private:
  slvm::Result<std::string> compile(const std::string& file, const std::string& name,
                                    const std::vector<std::string>& path);

  std::string program_;
  std::function<void(std::string_view)> show_;
  slvm::PluginFinder plugins_;
  // Made when the first source is met: most runs have compiled shaders only.
  std::unique_ptr<slc::Compiler> compiler_;
  std::unique_ptr<slvm::ir::ConstantEvaluator> evaluator_;
};

/// Whether a folder of the path has the source, and neither it nor one before it the compiled shader.
bool source_comes_first(const std::string& name, const std::vector<std::string>& path) {
  for (const std::string& folder : path) {
    if (find_file(name + ".slo", {folder})) return false;
    if (find_file(name + ".sl", {folder})) return true;
  }
  return false;
}

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Whether a source has "surface NAME (" or the like.
bool defines(std::string_view text, std::string_view name) {
  for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    size_t after = at + name.size(), kind_end = at;
    while (after < text.size() && is_space(text[after]))
      ++after;
    while (kind_end > 0 && is_space(text[kind_end - 1]))
      --kind_end;
    if (after >= text.size() || text[after] != '(' || kind_end == at) continue;
    for (std::string_view kind : {"surface", "displacement", "light", "volume", "imager"})
      if (text.substr(0, kind_end).ends_with(kind)) return true;
  }
  return false;
}

/// The source on the path that defines a shader whose file is not called after it; the first by folder and
/// name.
std::optional<std::string> source_defining(const std::string& name, const std::vector<std::string>& path) {
  namespace fs = std::filesystem;
  for (const std::string& folder : path) {
    std::vector<std::string> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
      if (entry.path().extension() == ".sl") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    for (const std::string& file : files)
      if (auto text = read_file(file); text && defines(*text, name)) return file;
  }
  return {};
}

slvm::Result<std::string> CompilingLoader::load(const std::string& name,
                                                const std::vector<std::string>& path) {
  bool as_it_is = name.ends_with(".slo");
  // One's own "mirror" beats the one that comes with Anemone, compiled or not.
  if (!as_it_is && source_comes_first(name, path)) return compile(*find_file(name + ".sl", path), name, path);
  if (auto compiled = find_file(as_it_is ? name : name + ".slo", path)) {
    auto bytes = load_compiled_shader(name, path);
    if (!bytes) return bytes;
    auto program = slvm::read_slo(std::as_bytes(std::span(*bytes)));
    if (!program) {
      // Often it is of another renderer, and its source beside it.
      auto source = as_it_is ? std::nullopt : find_file(name + ".sl", path);
      if (!source) return bytes; // whoever loads it says what is wrong
      show_(fmt::format("{}: warning: {}: {}; {} is compiled instead\n", program_, *compiled, program.error(),
                        *source));
      return compile(*source, name, path);
    }
    std::string warning = slvm::stale_warning(*program, *compiled, !as_it_is);
    if (warning.empty()) return bytes;
    show_(fmt::format("{}: warning: {}\n", program_, warning));
    if (as_it_is) return bytes;
    return compile(slvm::find_source(*program, *compiled, program->source_name), name, path);
  }
  if (as_it_is) return no_such_shader(name, path);
  if (auto source = find_file(name + ".sl", path)) return compile(*source, name, path);
  if (auto source = source_defining(name, path)) {
    show_(fmt::format("{}: warning: there is no \"{}.sl\"; the shader is taken from \"{}\"\n", program_, name,
                      *source));
    return compile(*source, name, path);
  }
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
  options.plugins = &plugins_;
  auto shaders = compiler_->compile(sources.add(file, std::move(*text)), options, sources, diagnostics);
  std::string messages = format_diagnostics(diagnostics, sources);
  if (!messages.empty()) show_(messages);
  if (diagnostics.has_errors()) return slvm::Error{fmt::format("\"{}\" does not compile", file)};
  for (const slc::CompiledShader& shader : shaders) {
    // The name may come with folders.
    if (shader.program.name != name && shader.program.name != std::filesystem::path(name).stem()) continue;
    std::vector<std::byte> bytes = slvm::write_slo(shader.program);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  if (auto other = source_defining(name, path); other && *other != file) {
    show_(fmt::format("{}: warning: \"{}\" defines no shader \"{}\"; it is taken from \"{}\"\n", program_,
                      file, name, *other));
    return compile(*other, name, path);
  }
  return slvm::Error{fmt::format("\"{}\" defines no shader \"{}\"", file, name)};
}

} // namespace

ShaderLoader make_compiling_loader(std::string program, std::function<void(std::string_view)> show,
                                   std::vector<std::string> plugin_folders) {
  auto loader =
      std::make_shared<CompilingLoader>(std::move(program), std::move(show), std::move(plugin_folders));
  return [loader](const std::string& name, const std::vector<std::string>& path) {
    return loader->load(name, path);
  };
}

} // namespace render::setup
