#include "slvm/tools/sltest/options.h"

#include "slvm/support/path_list.h"
#include "slvm/support/shared_library.h"
#include "slvm/tools/sltest/shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>

namespace slvm::sltest {
namespace {

constexpr const char* kVersion = "sltest (Anemone) 0.1.0";

constexpr const char* kRunGroup = "Running a shader";
constexpr const char* kTestGroup = "Running test files";
constexpr const char* kDescription = "Runs shaders on sample grids. With test files (.toml): checks what "
                                     "they expect. With a shader (.sl, .slo, or a "
                                     "name) or --expr: runs it once and prints or stores what it computes.";

std::string footer() {
  std::string text = "SHAPES (--shape)\n";
  for (const ShapeInfo& s : shapes())
    text += fmt::format("  {:<10} {}\n", s.name, s.doc);
  return text + R"help(
GRID
  Point (x, y) of a grid of nu x nv has u = x/(nu-1), v = y/(nv-1), s = u, t = v, du = 1/(nu-1), dv = 1/(nv-1); with
  --center u = (x+0.5)/nu, du = 1/nu. One column has u = 0.5, du = 1. P, N, Ng, dPdu and dPdv are those of the shape;
  N and Ng have unit length. I = (0, 0, 1), E = (0, 0, 0), Cs = Os = 1; "world", "camera", "object" and "shader" space
  are "current" space. Lights are run at Ps = P, Ns = N; imagers with P at the centres of pixels.

EXAMPLES
  sltest plastic.slo -g 64 64 --param Kd 0.8 --light distantlight -o Ci out.png
  sltest plastic.sl --print --param:type=color specularcolor "1 0 0"
  sltest --expr "smoothstep(0, 1, u)" -g 5 1 --print
  sltest --expr "float x = u; while (x < 1) x += x + 0.1; result = x;" -g 4 1
  sltest wood.sl -g 8 8 --shape sphere --set "P=point(u, v, u*v)" N="0 0 1" -o Ci wood.csv
  sltest matte.sl --light "pointlight:from=0 0 -3:intensity=9" --print
  sltest noisy.sl -g 256 256 --iters 100 -t 2 --runstats
  sltest tests/shadeops/*.toml --junit report.xml
  sltest plastic.toml --filter highlight -v
  sltest shaders/*.toml --coverage-pages coverage
  sltest wood.sl -g 64 64 --probe wood.sl:42:ring -o ring ring.exr

EXIT STATUS
  0 fine; 1 a test failed, or a shader is wrong; 2 wrong usage; 3 a file is missing; 4 internal error

Test files are described in docs/sltest.md.)help";
}

struct Texts {
  std::vector<int> resolution;
  std::vector<std::pair<std::string, std::string>> params;
  std::vector<std::string> settings, lights;
  std::string path, probe, plugins;
};

/// `--param:type=color NAME VALUE` becomes `--param "color NAME" VALUE`.
std::string rewrite_typed_params(std::vector<std::string>& args) {
  constexpr std::string_view kPrefix = "--param:";
  for (size_t i = 0; i < args.size(); ++i) {
    if (!args[i].starts_with(kPrefix)) continue;
    std::string_view rest = std::string_view(args[i]).substr(kPrefix.size());
    if (!rest.starts_with("type=")) return fmt::format("{}: write --param:type=TYPE NAME VALUE", args[i]);
    if (i + 1 < args.size()) args[i + 1] = fmt::format("{} {}", rest.substr(5), args[i + 1]);
    args[i] = "--param";
  }
  return "";
}

bool add_setting(const std::string& name, const std::string& value, std::vector<Setting>& settings,
                 std::string& error) {
  auto declaration = parse_declaration(name);
  if (!declaration) {
    error = declaration.error();
    return false;
  }
  settings.push_back({*declaration, parse_raw(value)});
  return true;
}

/// "NAME=VALUE"; names that are not predefined variables are primitive variables.
bool add_variable(const std::string& text, Setup& setup, std::string& error) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    error = fmt::format("--set wants NAME=VALUE, not '{}' (the shader's name goes before --set)", text);
    return false;
  }
  std::vector<Setting> one;
  if (!add_setting(text.substr(0, equals), text.substr(equals + 1), one, error)) return false;
  const bool predefined = find_global(one[0].what.name) != Global::kCount;
  (predefined ? setup.variables : setup.primvars).push_back(std::move(one[0]));
  return true;
}

/// "NAME[:param=value...]".
bool add_light(const std::string& text, Setup& setup, std::string& error) {
  ShaderRef light;
  light.form = ShaderForm::kFile;
  std::istringstream parts(text);
  std::getline(parts, light.text, ':');
  for (std::string part; std::getline(parts, part, ':');) {
    const size_t equals = part.find('=');
    if (equals == std::string::npos) {
      error = fmt::format("--light {}: '{}' is not param=value", text, part);
      return false;
    }
    if (!add_setting(part.substr(0, equals), part.substr(equals + 1), light.params, error)) return false;
  }
  setup.lights.push_back(std::move(light));
  return true;
}

/// "FILE:LINE:NAME".
bool set_probe(const std::string& text, Options& options) {
  const size_t name = text.rfind(':');
  if (name == std::string::npos || name == 0) return false;
  const size_t line = text.rfind(':', name - 1);
  if (line == std::string::npos || line == 0 || name + 1 == text.size()) return false;
  ProbeTarget target{text.substr(0, line), 0, text.substr(name + 1)};
  const std::string number = text.substr(line + 1, name - line - 1);
  target.line = static_cast<uint32_t>(std::atoi(number.c_str()));
  if (target.line == 0) return false;
  options.watch.probe = std::move(target);
  return true;
}

/// What CLI11 collected as texts, in the form that runs.
std::string finish(const Texts& texts, Options& options) {
  std::string error;
  if (!texts.resolution.empty()) {
    options.setup.grid.nu = texts.resolution[0];
    options.setup.grid.nv = texts.resolution[1];
  }
  for (const auto& [name, value] : texts.params)
    if (!add_setting(name, value, options.setup.shader.params, error)) return error;
  for (const std::string& s : texts.settings)
    if (!add_variable(s, options.setup, error)) return error;
  for (const std::string& s : texts.lights)
    if (!add_light(s, options.setup, error)) return error;
  if (!texts.probe.empty() && !set_probe(texts.probe, options)) {
    return fmt::format("--probe {}: write FILE.sl:LINE:NAME", texts.probe);
  }
  if (!options.watch.coverage_folder.empty()) options.watch.coverage = true;
  options.path = split_path_list(texts.path);
  options.config.plugin_folders = plugin_folders(texts.plugins);
  options.config.specialise = !options.no_specialise;
  bool tests = false, shaders = !options.expression.empty();
  for (const std::string& input : options.inputs)
    (input.ends_with(".toml") ? tests : shaders) = true;
  if (tests && shaders) return "test files and shaders cannot be run together";
  if (options.each_pass && !options.watch.probe) return "--probe-each goes with --probe";
  if (!tests && !shaders) return "give a test file, a shader, or --expr";
  if (!tests && options.inputs.size() + !options.expression.empty() > 1)
    return "only one shader can be run at a time";
  return "";
}

void add_run_options(CLI::App& app, Options& o, Texts& texts) {
  auto group = [](CLI::Option* option) { return option->group(kRunGroup); };
  group(app.add_option("-g,--res", texts.resolution, "Resolution of the grid (1 1)")
            ->expected(2)
            ->allow_extra_args(false))
      ->type_name("NU NV")
      ->check(CLI::Range(1, 16384).description(""));
  group(app.add_option("-o", o.outputs, "Store a variable: .png .tif .exr .pfm .csv .txt, or null"))
      ->type_name("NAME FILE")
      ->allow_extra_args(false);
  group(app.add_flag(
      "--print", o.print,
      "Print the variables of -o, or all results, point by point; the default without -o and --runstats"));
  group(app.add_option("--param", texts.params,
                       "Set a parameter; --param:type=TYPE NAME VALUE gives its type too"))
      ->type_name("NAME VALUE")
      ->allow_extra_args(false);
  group(app.add_option("--expr", o.expression, "Run an RSL expression, or statements that set `result`"))
      ->type_name("CODE");
  group(app.add_option("--prelude", o.prelude,
                       "Lines before the code of --expr: '#include \"noises.h\"', functions"))
      ->type_name("CODE");
  group(app.add_option("--set", texts.settings,
                       "Set variables or primitive variables to numbers or RSL expressions"))
      ->type_name("NAME=VALUE");
  group(app.add_option("--shape", o.setup.grid.shape, "Shape of the grid (plane)"));
  group(
      app.add_flag("--center", o.setup.grid.center, "Sample at the centres of cells, not from edge to edge"));
  group(app.add_option("--light", texts.lights, "Add a light; its parameters after colons"))
      ->type_name("NAME[:PARAM=VALUE...]")
      ->allow_extra_args(false);
  group(app.add_option("--iters", o.iterations, "Run so many times (1)")->type_name("N"))
      ->check(CLI::Range(1, 1 << 30).description(""));
  group(app.add_option("-t", o.threads, "Threads to run iterations on; 0: one for each processor (1)")
            ->type_name("N"))
      ->check(CLI::Range(0, 1024).description(""));
  group(app.add_flag("--runstats", o.run_stats, "Print times"));
  group(
      app.add_option("--probe", texts.probe,
                     "Print the value of a local variable behind a line, point by point; -o NAME stores it"))
      ->type_name("FILE:LINE:NAME");
  group(app.add_flag("--probe-each", o.each_pass, "With --probe: the values of all passes of a loop"));
}

void add_watch_options(CLI::App& app, Options& o) {
  constexpr const char* kGroup = "Watching shaders run, in tests too";
  auto group = [](CLI::Option* option) { option->group(kGroup); };
  group(app.add_flag("--debugnan", o.watch.nan,
                     "Name the lines where numbers that are not finite arise; status 1"));
  group(app.add_flag("--debuguninit", o.watch.uninit,
                     "Name the lines where variables are read that were never set; status 1"));
  group(app.add_flag("--coverage", o.watch.coverage,
                     "Tell which lines and branches of the tested shaders ran"));
  group(app.add_option("--coverage-pages", o.watch.coverage_folder,
                       "The same, and write a page for each source, and index.html, into this folder")
            ->type_name("FOLDER"));
  group(app.add_flag("--profile", o.watch.profile, "Print time and points by line of source"));
}

void add_common_options(CLI::App& app, Options& o, Texts& texts) {
  app.add_option("--path", texts.path,
                 "Folders, separated by colons, in which shaders and what they include are searched");
  app.add_option("--dso", texts.plugins,
                 "Folders, separated by colons, of plug-ins whose functions shaders call "
                 "(environment: ANEMONE_DSO_PATH)");
  app.add_option("--target", o.config.target,
                 "Instruction set: AVX3, AVX2, SSE4, SCALAR... (the best there is)");
  app.add_option("--strip", o.config.strip, "Points a strip, a multiple of 16 (128)")
      ->type_name("N")
      ->check([](const std::string& text) {
        const int n = std::atoi(text.c_str());
        return n >= 16 && n % 16 == 0 && n <= (1 << 24) ? std::string()
                                                        : std::string("must be a multiple of 16");
      });
  app.add_option("-O", o.config.opt_level, "Optimisation level of .sl sources: 0, 1 or 2 (2)")
      ->type_name("N")
      ->check(CLI::Range(0, 2).description(""));
  app.add_flag("--nospecialise", o.no_specialise, "Do not optimise the shader for its parameter values");
}

void add_test_options(CLI::App& app, Options& o) {
  constexpr const char* kTests = "Running test files";
  auto group = [](CLI::Option* option) { option->group(kTests); };
  group(app.add_option("--filter", o.filter, "Run only cases whose name matches this regular expression"));
  group(app.add_flag("--list", o.list, "List the cases instead of running them"));
  group(app.add_flag("--quick", o.quick,
                     "Run each case once, not with several strip widths, -O levels and targets"));
  group(app.add_flag("--update-goldens", o.goldens.update,
                     "Write the pictures of expect.image that are missing or differ, instead of failing"));
  group(
      app.add_option(
             "--failures", o.goldens.failures,
             "Where to write results that differ from their pictures, and the differences (sltest-failures)")
          ->type_name("FOLDER"));
  group(app.add_flag(
      "--bench", o.bench,
      "Run each case once and time it: compiling, binding, and each point (median of many runs)"));
  group(app.add_option("--json", o.json, "Write what was found, coverage and times too, as JSON")
            ->type_name("FILE"));
  group(app.add_option("--junit", o.junit, "Write a JUnit report")->type_name("FILE"));
}

/// An option that means nothing for what is run.
std::string misplaced_option(const CLI::App& app, const Options& options) {
  const bool tests = !options.inputs.empty() && options.inputs[0].ends_with(".toml");
  for (const CLI::Option* o : app.get_options())
    if (o->count() && o->get_group() == (tests ? kRunGroup : kTestGroup))
      return fmt::format("{} is for {}", o->get_name(),
                         tests ? "one shader, not for test files" : "test files (.toml)");
  return "";
}

} // namespace

ParseOutcome parse_options(int argc, const char* const* argv, Options& options) {
  CLI::App app(kDescription, "sltest");
  Texts texts;
  app.add_option("INPUT", options.inputs,
                 "Test files (.toml), or one shader: .sl, .slo, or a name to be searched for");
  add_run_options(app, options, texts);
  add_watch_options(app, options);
  add_common_options(app, options, texts);
  add_test_options(app, options);
  app.add_flag("-v,--verbose", options.verbose, "Name passing cases too");
  app.get_option("--verbose")->group(kTestGroup);
  app.set_version_flag("--version", kVersion);
  app.footer(footer());

  ParseOutcome outcome;
  std::vector<std::string> args(argv + std::min(argc, 1), argv + argc);
  std::string error = rewrite_typed_params(args);
  if (error.empty()) {
    std::reverse(args.begin(), args.end()); // the order CLI11 wants
    try {
      app.parse(args);
    } catch (const CLI::ParseError& e) {
      std::ostringstream out, err;
      outcome.done = true;
      outcome.status = app.exit(e, out, err) == 0 ? kOk : kUsage;
      outcome.out = out.str();
      outcome.err = err.str();
      return outcome;
    }
    error = finish(texts, options);
    if (error.empty()) error = misplaced_option(app, options);
  }
  if (!error.empty())
    outcome = {true, kUsage, "", fmt::format("sltest: {}\nRun with --help for more information.\n", error)};
  return outcome;
}

} // namespace slvm::sltest
