// sloinfo: what a compiled shader is and takes. Arguments, finding files, exit statuses; the output formats
// are in shader_description.h. Read main() first, at the end.
#include "slc/compiler.h"
#include "slc/tools/shader_json.h"
#include "slvm/evaluator.h"
#include "slvm/format/slo.h"
#include "slvm/plugin/finder.h"
#include "slvm/support/path_list.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace {

namespace fs = std::filesystem;

// Exit statuses; the greatest of all inputs counts.
enum ExitCode { kFine = 0, kBadInput = 1, kBadUsage = 2, kMissingFile = 3, kInternal = 4 };

constexpr const char* kFooter = R"(
EXAMPLES
  sloinfo plastic                     the shader plastic.slo or plastic.sl on the search path
  sloinfo --param Kd shaders/*.slo    one parameter of many shaders
  sloinfo --uses --messages plastic   textures, lights, coordinate systems...; messages to other shaders
  sloinfo --disassemble plastic.sl    the code, with the lines of the source it was made from
  sloinfo --json plastic.sl           for programs; docs/sloinfo-schema.md describes the form

EXIT STATUS
  0 fine; 1 not a shader, or no such parameter; 2 wrong usage; 3 a file is missing; 4 internal error)";

struct Options {
  std::vector<std::string> inputs;
  std::string path, param, plugin_folders;
  bool plugins = false, metadata = false, json = false;
  slc::Listings listings;
};

fs::path program_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// The folders of --path, then where shaders are installed, or lie in a fresh build.
std::vector<std::string> search_path(const std::string& text) {
  std::vector<std::string> folders = slvm::split_path_list(text);
  folders.insert(folders.begin(), "");
  folders.push_back((program_folder() / "../share/anemone/shaders").string());
  folders.push_back((program_folder() / "../shaders").string());
  return folders;
}

class Run {
public:
  explicit Run(const Options& options)
      : options_(options), folders_(search_path(options.path)),
        plugins_(slvm::plugin_folders(options.plugin_folders)) {}

  int run() {
    for (const std::string& input : options_.inputs)
      describe(input);
    std::string out;
    if (options_.json)
      out = slc::shaders_as_json(shaders_, options_.param, options_.listings);
    else
      for (const slc::Inspected& shader : shaders_)
        out += text_of(shader);
    std::fwrite(out.data(), 1, out.size(), stdout);
    return worst_;
  }

private:
  void fail(int code, const std::string& text) {
    fmt::print(stderr, "{}{}", text, text.ends_with('\n') ? "" : "\n");
    worst_ = std::max(worst_, code);
  }

  std::string text_of(const slc::Inspected& shader) const {
    if (options_.plugins) return slc::plugins_as_text(shader.program);
    if (options_.metadata) return slc::annotations_as_xml(shader.program);
    if (options_.listings.any()) return slc::listings_as_text(shader, options_.listings);
    return slc::shader_as_text(shader.program, options_.param);
  }

  void describe(const std::string& input) {
    const fs::path file = slvm::find_shader_file(input, folders_);
    if (file.empty()) return fail(kMissingFile, fmt::format("sloinfo: no shader '{}'", input));
    auto bytes = slvm::read_file(file.string());
    if (!bytes) return fail(kMissingFile, fmt::format("sloinfo: {}", bytes.error()));
    if (file.extension() == ".sl")
      return compile(file.string(), std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    auto program = slvm::read_slo(*bytes);
    if (!program) return fail(kBadInput, fmt::format("sloinfo: {}: {}", file.string(), program.error()));
    if (std::string warning = slvm::stale_warning(*program, file.string()); !warning.empty())
      fmt::print(stderr, "sloinfo: warning: {}\n", warning);
    add(std::move(*program), file.string());
  }

  void compile(const std::string& name, std::string source) {
    slvm::SourceManager sources;
    slvm::Diagnostics diags;
    diags.no_warnings = true;
    slc::CompileOptions compile_options;
    compile_options.evaluator = evaluator_.get();
    compile_options.preprocess.include_dirs = folders_;
    compile_options.plugins = &plugins_;
    auto shaders = compiler_.compile(sources.add(name, std::move(source)), compile_options, sources, diags);
    if (diags.has_errors()) return fail(kBadInput, slvm::format_diagnostics(diags, sources));
    if (shaders.empty())
      return fail(kBadInput, fmt::format("sloinfo: {}: there is no shader in this file", name));
    for (slc::CompiledShader& shader : shaders)
      add(std::move(shader.program), name);
  }

  void add(slvm::Program program, const std::string& file) {
    if (!options_.param.empty()) {
      std::vector<std::string_view> names;
      for (const slvm::Param& p : program.params)
        names.push_back(p.name);
      if (std::find(names.begin(), names.end(), options_.param) == names.end()) {
        std::string text = fmt::format("sloinfo: {} \"{}\" has no parameter '{}'",
                                       slvm::shader_kind_name(program.kind), program.name, options_.param);
        if (std::string_view near = slvm::nearest_name(options_.param, names); !near.empty())
          text += fmt::format("; did you mean '{}'?", near);
        return fail(kBadInput, text);
      }
    }
    const slc::Listings& listings = options_.listings;
    bool uses = listings.uses || listings.messages || (options_.json && !listings.any());
    auto shader = slc::inspect(std::move(program), file, uses);
    if (!shader) return fail(kBadInput, fmt::format("sloinfo: {}: {}", file, shader.error()));
    shaders_.push_back(std::move(*shader));
  }

  const Options& options_;
  std::vector<std::string> folders_;
  slvm::PluginFinder plugins_;
  slc::Compiler compiler_;
  std::unique_ptr<slvm::ir::ConstantEvaluator> evaluator_ = slvm::make_kernel_evaluator();
  std::vector<slc::Inspected> shaders_;
  int worst_ = kFine;
};

int run(int argc, char** argv) {
  CLI::App app("Describes shaders: kind, name, parameters and their defaults.", "sloinfo");
  Options options;
  app.add_option("SHADER", options.inputs, "A .slo file, a .sl source, or a name to be searched for")
      ->required();
  auto* plugins = app.add_flag("-p", options.plugins, "Print the plug-ins the shader calls, one path a line");
  auto* metadata = app.add_flag("-m", options.metadata, "Print the shader's annotations as XML");
  auto* json = app.add_flag("--json", options.json,
                            "Print everything but the code as JSON, or what these options ask for: "
                            "--messages --uses --sources --source-map --disassemble");
  plugins->excludes(metadata)->excludes(json);
  metadata->excludes(json);
  auto* param = app.add_option("--param", options.param, "Print only this parameter")->type_name("NAME");
  slc::Listings& listings = options.listings;
  const std::tuple<const char*, bool&, const char*> flags[] = {
      {"--messages", listings.messages, "Print which messages of other shaders are read, and what is output"},
      {"--uses", listings.uses,
       "Print functions, textures, rays, lights, derivatives, attributes, spaces and variables, with their "
       "lines"},
      {"--sources", listings.sources,
       "Print the compiler, the source files, and whether they have changed since"},
      {"--source-map", listings.source_map,
       "Print which words of the code belong to which line of the source"},
      {"--disassemble", listings.disassembly, "Print the code between the lines of the source"}};
  for (auto& [name, flag, text] : flags)
    app.add_flag(name, flag, text)->excludes(plugins)->excludes(metadata)->excludes(param);
  app.add_option("--path", options.path, "Folders, separated by colons, in which shaders are searched")
      ->type_name("DIRS");
  app.add_option("--dso", options.plugin_folders,
                 "Folders, separated by colons, of plug-ins whose functions a .sl source calls "
                 "(environment: ANEMONE_DSO_PATH)")
      ->type_name("DIRS");
  app.set_version_flag("--version", "sloinfo (Anemone) 0.1.0");
  app.footer(kFooter);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kBadUsage;
  }
  return Run(options).run();
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "sloinfo: internal error: {}\n", e.what());
    return kInternal;
  }
}
