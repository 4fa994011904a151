// Arguments of slc by CLI11, which knows one-letter options and long ones with two dashes: the compiler's
// traditional longer ones with a single dash are respelled first.
#include "slc/tools/slc_options.h"

#include "slc/diag/messages.h"
#include "slvm/support/path_list.h"
#include "slvm/support/shared_library.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace slc {
namespace {

namespace fs = std::filesystem;

// Options of several letters behind one dash, and what they are called here.
constexpr std::string_view kSingleDash[] = {"-MM",     "-MD",   "-MMD",     "-MF",        "-MT",
                                            "-nw",     "-lint", "-nolint",  "-lintpoint", "-lintspace",
                                            "-strict", "-help", "-version", "-dso"};

struct Dialect {
  std::string_view name;
  std::vector<std::string> macros;
};
const std::vector<Dialect>& dialects() {
  static const std::vector<Dialect> kDialects = {
      {"prman", {"PRMAN=1", "PRMan=1"}},
      {"3delight", {"DELIGHT=1", "__3DELIGHT__=1"}},
      {"aqsis", {"AQSIS=1"}},
      {"pixie", {"PIXIE=1"}},
      {"bmrt", {"BMRT=1"}},
  };
  return kDialects;
}

std::vector<std::string> respelled(int argc, char** argv) {
  std::vector<std::string> args;
  if (const char* preset = std::getenv("SLC_OPTIONS")) {
    std::istringstream words(preset);
    for (std::string word; words >> word;)
      args.push_back(word);
  }
  args.insert(args.end(), argv + 1, argv + argc);
  for (std::string& arg : args)
    if (std::find(std::begin(kSingleDash), std::end(kSingleDash), arg) != std::end(kSingleDash))
      arg.insert(0, "-");
  return args;
}

// What -W and the lint switches say. False: there is no such warning.
bool switch_warning(std::string_view name, slvm::Diagnostics& diags) {
  bool on = !name.starts_with("no-");
  if (!on) name.remove_prefix(3);
  if (name == "error") {
    diags.warnings_are_errors = on;
    return true;
  }
  std::vector<std::string_view> members = warnings_named(name);
  for (std::string_view member : members) {
    if (on)
      diags.disabled.erase(std::string(member));
    else
      diags.disabled.insert(std::string(member));
  }
  return !members.empty();
}

struct Flags {
  std::vector<std::string> warnings;
  bool mm = false, m = false, md = false, mmd = false;
  bool lint = false, nolint = false, lintpoint = false, lintspace = false, strict = false;
  bool version = false;
  std::string dialect, explain;
  std::vector<std::string> plugins;
};

void add_options(CLI::App& app, ToolOptions& o, Flags& f) {
  auto list = [&](const char* name, std::vector<std::string>& target, const char* help) {
    app.add_option(name, target, help)->allow_extra_args(false)->take_all();
  };
  app.add_option("files", o.inputs,
                 "Shader sources; folders stand for all .sl files in them; - is standard input");
  app.add_option("-o", o.output, "Write the one shader to this file; - is standard output");
  app.add_option("-d", o.output_dir, "Write shaders into this folder, named after themselves");
  app.add_option("-s", o.stdin_name, "Name of standard input in messages");
  list("-I", o.compile.preprocess.include_dirs, "Add a folder to search for included files");
  list("-D", o.compile.preprocess.defines, "Define a macro: NAME or NAME=VALUE");
  list("-U", o.compile.preprocess.undefines, "Undefine a macro; wins over -D");
  list("--dso", f.plugins,
       "Add folders of plug-ins, separated by colons: libraries with functions that the source may call");
  app.add_option("--dialect", f.dialect,
                 "Define the macros of another compiler: prman, 3delight, aqsis, pixie, bmrt");
  app.add_flag("-E", o.preprocess_only, "Preprocess only, to standard output or -o");
  app.add_flag("-M", f.m, "Print a make rule with all included files instead of compiling");
  app.add_flag("--MM", f.mm, "-MM: the same without files from the folders of SLC_INCLUDE");
  app.add_flag("--MD", f.md, "-MD: write the rule beside the output");
  app.add_flag("--MMD", f.mmd, "-MMD: the same without files from the folders of SLC_INCLUDE");
  app.add_option("--MF", o.dependency_file, "-MF FILE: write the rule to FILE");
  app.add_option("--MT", o.dependency_target, "-MT NAMES: the target of the rule, as it stands");
  app.add_option("-O", o.compile.optimise, "Optimise: 0 not at all, 1 cheaply, 2 fully (default)")
      ->check(CLI::Range(0, 2));
  app.add_option("--dump", o.dump, "Print a stage instead of writing files: ast, ir or bytecode")
      ->check(CLI::IsMember({"ast", "ir", "bytecode"}));
  app.add_option(
         "--explain-varying", o.explain,
         "Print why the variables of this name are varying, instead of writing files; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->take_all()
      ->excludes("--dump")
      ->excludes("-E");
  list("-W", f.warnings, "-Wname, -Wno-name: switch a warning on or off; -Wall, -Werror");
  app.add_option("--explain", f.explain, "Tell what a warning means, by its name; all: list them");
  app.add_flag("--nw", o.diagnostics.no_warnings, "-nw: no warnings");
  app.add_flag("--lint", f.lint,
               "-lint: also warn of mixed points and vectors, mixed spaces, unused parameters");
  app.add_flag("--nolint", f.nolint, "-nolint: none of these");
  app.add_flag("--lintpoint", f.lintpoint, "-lintpoint: only of mixed points and vectors");
  app.add_flag("--lintspace", f.lintspace, "-lintspace: only of mixed spaces");
  app.add_flag("--strict", f.strict, "-strict: all warnings");
  app.add_option_function<std::string>(
         "--diagnostics", [&](const std::string& form) { o.json = form == "json"; },
         "Form of messages: text, or json, an object a line (docs/diagnostics-schema.md)")
      ->check(CLI::IsMember({"text", "json"}));
  app.add_option("--error-limit", o.diagnostics.error_limit,
                 "Show so many errors of a file at most (20); 0: all");
  app.add_flag("-q", o.quiet, "Do not print the names of the files written");
  app.add_flag("-v", o.verbose, "Print what is being compiled");
  app.add_flag("--version", f.version, "Print the version");
  app.footer(
      "Environment: SLC_OPTIONS holds options that come before those of the command line, SLC_INCLUDE "
      "folders to\n"
      "search after those of -I, ANEMONE_DSO_PATH folders after those of --dso.\n"
      "Exit status: 0 fine, 1 the input is wrong, 2 wrong usage, 3 a file is missing, 4 internal error.");
}

std::optional<int> usage_error(std::string_view text) {
  std::cerr << "slc: " << text << "\nslc --help lists the options\n";
  return 2;
}

// `name` as it stands behind -W.
std::optional<int> no_such_warning(std::string_view name) {
  std::vector<std::string_view> names = {"error"};
  for (const WarningInfo& w : warnings())
    names.push_back(w.name);
  for (const WarningGroup& group : warning_groups())
    names.push_back(group.name);
  std::string_view prefix = name.starts_with("no-") ? "no-" : "";
  std::string_view near = slvm::nearest_name(name.substr(prefix.size()), names);
  std::string text = "there is no warning '" + std::string(name) + "'";
  if (near.empty()) return usage_error(text + "; --explain all lists them");
  return usage_error(text + "; did you mean '" + std::string(prefix) + std::string(near) + "'?");
}

// From what was parsed to what it means.
std::optional<int> apply(ToolOptions& o, const Flags& f) {
  if (f.version) {
    std::cout << kVersion << '\n';
    return 0;
  }
  if (!f.explain.empty()) {
    std::string text = explain_warning(f.explain);
    if (text.empty()) return no_such_warning(f.explain);
    std::cout << text;
    return 0;
  }
  if (o.inputs.empty()) return usage_error("no input files");
  if (o.inputs.size() > 1 && !o.output.empty())
    return usage_error("-o names one file, but there are several inputs; use -d");
  for (const WarningInfo& w : warnings())
    if (!w.on) o.diagnostics.disabled.insert(std::string(w.name));
  for (auto [set, name] : {std::pair(f.lint, "lint"),
                           {f.nolint, "no-lint"},
                           {f.lintpoint, "lint-point"},
                           {f.lintspace, "lint-space"},
                           {f.strict, "strict"}})
    if (set) switch_warning(name, o.diagnostics);
  for (const std::string& name : f.warnings)
    if (!switch_warning(name, o.diagnostics)) return no_such_warning(name);
  if (!f.dialect.empty()) {
    auto found = std::find_if(dialects().begin(), dialects().end(),
                              [&](const Dialect& d) { return d.name == f.dialect; });
    if (found == dialects().end()) return usage_error("there is no dialect '" + f.dialect + "'");
    auto& defines = o.compile.preprocess.defines;
    defines.insert(defines.end(), found->macros.begin(), found->macros.end());
  }
  if (const char* folders = std::getenv("SLC_INCLUDE"))
    for (std::string& folder : slvm::split_path_list(folders))
      o.compile.preprocess.system_dirs.push_back(std::move(folder));
  std::string plugins;
  for (const std::string& folders : f.plugins)
    plugins += folders + ":";
  o.plugin_folders = slvm::plugin_folders(plugins);
  o.dependencies_only = f.m || f.mm;
  o.dependencies = f.md || f.mmd;
  o.system_dependencies = !f.mm && !f.mmd;
  return std::nullopt;
}

} // namespace

std::optional<int> parse_arguments(int argc, char** argv, ToolOptions& options) {
  CLI::App app("slc compiles shaders written in the RenderMan Shading Language to .slo files.", "slc");
  Flags flags;
  add_options(app, options, flags);
  std::vector<std::string> args = respelled(argc, argv);
  std::reverse(args.begin(), args.end()); // as CLI11 wants them
  try {
    app.parse(args);
  } catch (const CLI::ParseError& e) {
    return app.exit(e, std::cout, std::cerr) == 0 ? 0 : 2;
  }
  return apply(options, flags);
}

} // namespace slc
