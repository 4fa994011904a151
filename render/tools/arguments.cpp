// The command line of slrender: the spellings of PRMan and Aqsis (-progress, -t:4, -crop ...) and GNU's
// (--progress).
#include "render/tools/arguments.h"

#include "render/setup/places.h"
#include "render/state/search_path.h"
#include "slvm/support/shared_library.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <thread>

namespace render::tools {

namespace {

constexpr std::string_view kLongNames[] = {"help",       "version",        "progress",
                                           "Progress",   "progressformat", "crop",
                                           "frames",     "framelist",      "res",
                                           "cwd",        "shaders",        "archives",
                                           "threads",    "verbose",        "nowarn",
                                           "Werror",     "preview",        "procedurals",
                                           "dso",        "allow-programs", "program-timeout",
                                           "statistics", "statisticsfile"};

/// "-progress" as users of other renderers write it becomes "--progress", "-t:4" "--threads=4", and so does
/// "-p:4", the processes of older releases.
std::vector<std::string> normalise(int argc, char** argv) {
  std::vector<std::string> out;
  for (int i = 1; i < argc; ++i) {
    std::string a = argv[i];
    if (a.starts_with("-t:") || a.starts_with("-p:")) {
      out.push_back("--threads=" + a.substr(3));
      continue;
    }
    // Its file name is optional and must not be taken from the scenes that follow.
    if (a == "--preview" || a == "-preview") a = "--preview=preview.png";
    std::string_view name = std::string_view(a).substr(0, a.find('='));
    if (name.size() > 2 && name[0] == '-' && name[1] != '-')
      for (std::string_view known : kLongNames)
        if (name.substr(1) == known) {
          a.insert(0, "-");
          break;
        }
    out.push_back(std::move(a));
  }
  return out;
}

/// "4", "all" or "0" (all processors), "-1" (all but one). Empty: none of these.
std::optional<int> thread_count(const std::string& text) {
  if (text == "all") return 0;
  char* end = nullptr;
  long n = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || n > 4096 || n < -4096) return {};
  if (n >= 0) return static_cast<int>(n);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) + static_cast<int>(n));
}

/// "1,3-5": single numbers and ranges, appended. False: it is no such list.
bool add_frames(std::string_view list, std::vector<std::array<int, 2>>& frames) {
  for (size_t from = 0; from <= list.size();) {
    const size_t end = std::min(list.find(',', from), list.size());
    const std::string_view part = list.substr(from, end - from);
    std::array<int, 2> range{};
    auto [first_end, wrong] = std::from_chars(part.begin(), part.end(), range[0]);
    range[1] = range[0];
    if (wrong == std::errc() && first_end != part.end() && *first_end == '-') {
      const auto second = std::from_chars(first_end + 1, part.end(), range[1]);
      first_end = second.ptr;
      wrong = second.ec;
    }
    if (wrong != std::errc() || first_end != part.end() || range[0] > range[1]) return false;
    frames.push_back(range);
    from = end + 1;
  }
  return true;
}

/// Search paths as they are given.
struct Places {
  std::string shaders, archives, procedurals, plugins;
};

void add_places(CLI::App& app, Places& places, Arguments& out) {
  app.add_option("--cwd", out.directory, "change to this directory first");
  app.add_option("--shaders", places.shaders,
                 "directories for shaders, separated by ':' (@: the usual ones); @ in a scene's path "
                 "(environment: ANEMONE_SHADERS)");
  app.add_option("--archives", places.archives, "the same for archives (environment: ANEMONE_ARCHIVES)");
  app.add_option(
      "--procedurals", places.procedurals,
      "the same for programs and plug-ins that make geometry; plug-ins (Procedural \"DynamicLoad\") come "
      "from nowhere else (environment: ANEMONE_PROCEDURALS)");
  app.add_option(
      "--dso", places.plugins,
      "directories of plug-ins that shaders may call, separated by ':'; by default only those that come with "
      "Anemone: they are native code (environment: ANEMONE_DSO_PATH)");
}

void take_places(const Places& places, Arguments& out) {
  out.shader_path = setup::search_path(places.shaders, "ANEMONE_SHADERS", setup::standard_shader_folders());
  out.archive_path = setup::search_path(places.archives, "ANEMONE_ARCHIVES", {});
  out.procedural_path = setup::search_path(places.procedurals, "ANEMONE_PROCEDURALS", {});
  out.procedural_folders = setup::procedural_folders(places.procedurals, "ANEMONE_PROCEDURALS");
  out.plugin_folders = slvm::plugin_folders(places.plugins);
}

/// What of the scenes is rendered, as it is given.
struct Parts {
  std::vector<float> crop;
  std::vector<int> resolution, frames;
  std::string frame_list;
};

void add_parts(CLI::App& app, Parts& parts) {
  app.add_option("--crop", parts.crop, "render part of the frame: xmin xmax ymin ymax, from 0 to 1")
      ->expected(4)
      ->allow_extra_args(false);
  app.add_option("--res", parts.resolution, "resolution: width and height in pixels")
      ->expected(2)
      ->allow_extra_args(false);
  app.add_option("--frames", parts.frames, "render only the frames with numbers from the first to the second")
      ->expected(2)
      ->allow_extra_args(false);
  app.add_option("--framelist", parts.frame_list,
                 "render only these frames: numbers and ranges, as in 1,3-5");
}

/// Throws usage errors.
void take_parts(const Parts& parts, Arguments& out) {
  if (parts.resolution.size() == 2 && (parts.resolution[0] < 1 || parts.resolution[1] < 1))
    throw CLI::ValidationError("-res", "expected two positive numbers");
  if (parts.crop.size() == 4 && (parts.crop[0] >= parts.crop[1] || parts.crop[2] >= parts.crop[3]))
    throw CLI::ValidationError("-crop", "expected xmin < xmax and ymin < ymax");
  if (parts.frames.size() == 2) out.frames.push_back({parts.frames[0], parts.frames[1]});
  if (parts.frames.size() == 2 && parts.frames[0] > parts.frames[1])
    throw CLI::ValidationError("-frames", "expected the number of the first frame, and of the last");
  if (!parts.frame_list.empty() && !add_frames(parts.frame_list, out.frames))
    throw CLI::ValidationError("-framelist", "expected numbers and ranges such as 1,3-5, found \"" +
                                                 parts.frame_list + "\"");
  if (parts.crop.size() == 4) out.crop = {parts.crop[0], parts.crop[1], parts.crop[2], parts.crop[3]};
  if (parts.resolution.size() == 2) out.resolution = {parts.resolution[0], parts.resolution[1]};
}

} // namespace

Arguments parse_arguments(int argc, char** argv) {
  Arguments out;
  CLI::App app("Renders RIB scenes with RSL shaders.", "slrender");
  app.set_help_flag("-h,--help", "print this and leave");
  app.set_version_flag("--version", "slrender 0.1.0 (Anemone)");
  std::string threads = "all";
  Places places;
  bool updating = false, lines = false;
  Parts parts;
  app.add_option("files", out.files,
                 "RIB files, read one after the other with shared state; standard input when none, or for -");
  app.add_flag("--progress", updating, "show progress on one line that is updated");
  app.add_flag("--Progress", lines, "show progress as lines, for farm software: R90000 and the percentage");
  app.add_option("--progressformat", out.progress_format,
                 "form of the progress lines; {:3.0f} is the percentage");
  app.add_option("-t,--threads", threads,
                 "-t:N threads; -t:0 or -t:all for all processors, -t:-N for all but N; -p:N is the same");
  add_parts(app, parts);
  app.add_option(
      "-d,--display", out.display,
      "where the first Display goes: a file name such as out.png or ./out, or a type such as openexr");
  add_places(app, places, out);
  app.add_flag("--allow-programs", out.allow_programs,
               "let scenes run the programs they name (Procedural \"RunProgram\")");
  app.add_option("--program-timeout", out.program_seconds, "seconds such a program may be silent (60)")
      ->check(CLI::Range(0.01, 1e6));
  app.add_flag(
      "-v,--verbose", [&](auto n) { out.verbosity = 1 + static_cast<int>(n); }, "say what is done");
  app.add_option(
      "--preview", out.preview,
      "--preview=FILE: keep a PNG of what is finished up to date while rendering; alone: preview.png");
  app.add_flag("--statistics", out.statistics,
               "print what each frame cost: grids, shading by shader, memory");
  app.add_option("--statisticsfile", out.statistics_file,
                 "write it to a file, a line of JSON for each frame");
  app.add_flag("--nowarn", out.no_warnings, "no warnings");
  app.add_flag("--Werror", out.warnings_are_errors, "warnings are errors");
  app.footer(
      "Exit status: 0 fine, 1 errors in a scene, 2 wrong usage, 3 a file is missing, 4 internal error.");

  std::vector<std::string> words = normalise(argc, argv);
  std::reverse(words.begin(), words.end()); // as CLI11 wants them
  try {
    app.parse(words);
    auto count = thread_count(threads);
    if (!count) throw CLI::ValidationError("-t", "expected a number or all, found \"" + threads + "\"");
    out.threads = *count;
    take_parts(parts, out);
  } catch (const CLI::ParseError& e) {
    int status = app.exit(e);
    out.exit_status = status == 0 ? 0 : 2;
    return out;
  }
  if (lines)
    out.progress = ProgressStyle::kLines;
  else if (updating)
    out.progress = ProgressStyle::kUpdating;
  if (out.files.empty()) out.files.emplace_back("-");
  take_places(places, out);
  return out;
}

} // namespace render::tools
