// slrender: reads RIB files and renders every world block in them.
#include "render/photons/photon_tracer.h"
#include "render/renderer.h"
#include "render/ri/plug_in_calls.h"
#include "render/setup/compiling_loader.h"
#include "render/statistics.h"
#include "render/tools/arguments.h"
#include "render/tools/heap.h"
#include "slvm/support/whole_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <mutex>
#include <new>
#include <unistd.h>

namespace {

using render::tools::Arguments;
using render::tools::ProgressStyle;

enum ExitStatus : int { kFine = 0, kWrongInput = 1, kUsage = 2, kMissingFile = 3, kInternal = 4 };

/// Prints messages as they come and remembers whether there were errors.
class Messages {
public:
  explicit Messages(const Arguments& arguments) {
    diagnostics.warnings_are_errors = arguments.warnings_are_errors;
    diagnostics.no_warnings = arguments.no_warnings;
  }

  void flush() {
    std::string text = format_diagnostics(diagnostics, sources, ::isatty(STDERR_FILENO) != 0);
    std::fputs(text.c_str(), stderr);
    failed = failed || diagnostics.has_errors();
    slvm::Diagnostics fresh;
    fresh.error_limit = diagnostics.error_limit;
    fresh.warnings_are_errors = diagnostics.warnings_are_errors;
    fresh.no_warnings = diagnostics.no_warnings;
    diagnostics = std::move(fresh);
  }

  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  bool failed = false;
};

/// Shows whole percents, each once.
class Progress {
public:
  explicit Progress(const Arguments& arguments)
      : style_(arguments.progress), format_(arguments.progress_format) {}

  void show(double fraction) {
    int percent = static_cast<int>(fraction * 100);
    if (percent == last_) return;
    last_ = percent;
    std::string text;
    try {
      text = fmt::format(fmt::runtime(format_), static_cast<double>(percent));
    } catch (const fmt::format_error&) { // the user's own format
      text = fmt::format("R90000 {:3d}%", percent);
    }
    if (style_ == ProgressStyle::kLines)
      fmt::print(stderr, "{}\n", text);
    else
      fmt::print(stderr, "\r{}{}", text, percent == 100 ? "\n" : "");
  }
  bool wanted() const { return style_ != ProgressStyle::kNone; }

private:
  ProgressStyle style_;
  std::string format_;
  int last_ = -1;
};

/// Which frames are rendered, and whether there was one of them.
class WantedFrames {
public:
  explicit WantedFrames(const Arguments& arguments) : ranges_(arguments.frames) {}
  bool has(int number) {
    for (const auto& [first, last] : ranges_)
      if (number >= first && number <= last) return any_ = true;
    return false;
  }
  bool any() const { return any_; }

private:
  const std::vector<std::array<int, 2>>& ranges_;
  bool any_ = false;
};

void override_options(const Arguments& arguments, render::Options& options) {
  if (arguments.resolution) {
    options.xres = (*arguments.resolution)[0];
    options.yres = (*arguments.resolution)[1];
  }
  if (arguments.crop) options.crop = *arguments.crop;
  if (arguments.display.empty()) return;
  if (options.displays.empty()) options.displays.push_back({"ri.tif", "file", "rgba", {}, {}});
  render::DisplayRequest& d = options.displays.front();
  const std::filesystem::path file(arguments.display);
  if (file.has_extension() || file.has_parent_path()) {
    d.name = arguments.display;
    d.type = "file";
  } else {
    d.type = arguments.display;
  }
}

int run(const Arguments& arguments) {
  if (!arguments.directory.empty()) {
    std::error_code error;
    std::filesystem::current_path(arguments.directory, error);
    if (error) {
      fmt::print(stderr, "slrender: error: cannot change to \"{}\": {}\n", arguments.directory,
                 error.message());
      return kMissingFile;
    }
  }
  Messages messages(arguments);
  Progress progress(arguments);
  render::RendererSettings settings;
  settings.threads = arguments.threads;
  settings.allow_programs = arguments.allow_programs;
  settings.preview = arguments.preview;
  settings.program_seconds = arguments.program_seconds;
  settings.plugin_folders = arguments.plugin_folders;
  settings.procedural_folders = arguments.procedural_folders;
  render::ri::PlugInCalls plug_in_calls;
  settings.around_plug_in = plug_in_calls.around();
  settings.shader_loader = render::setup::make_compiling_loader(
      "slrender", [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); },
      arguments.plugin_folders);
  settings.override_options = [&](render::Options& o) { override_options(arguments, o); };
  WantedFrames wanted(arguments);
  if (!arguments.frames.empty()) settings.wants_frame = [&](int number) { return wanted.has(number); };
  settings.flush_messages = [&] { messages.flush(); };
  settings.print = [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); };
  std::string statistics;
  settings.statistics = [&](const render::FrameStatistics& s) {
    if (arguments.statistics || s.asked_for) std::fputs(format_text(s).c_str(), stderr);
    statistics += format_json(s) + "\n";
  };
  if (arguments.statistics)
    settings.photons = [](const render::PhotonReport& r) { std::fputs(format_text(r).c_str(), stderr); };
  if (arguments.statistics)
    settings.plugin_statistics = [](std::string_view text) {
      std::fwrite(text.data(), 1, text.size(), stderr);
    };
  if (progress.wanted()) settings.progress = [&](double fraction) { progress.show(fraction); };

  render::Renderer renderer(messages.sources, messages.diagnostics, settings);
  plug_in_calls.attach(renderer, messages.diagnostics);
  renderer.set_standard_path("shader", arguments.shader_path);
  renderer.set_standard_path("archive", arguments.archive_path);
  renderer.set_standard_path("procedural", arguments.procedural_path);
  bool missing = false;
  for (const std::string& name : arguments.files) {
    if (name == "-") {
      std::string text{std::istreambuf_iterator<char>(std::cin), {}};
      renderer.read_text("<stdin>", std::move(text));
    } else if (!renderer.read_file(name)) {
      fmt::print(stderr, "slrender: error: cannot read \"{}\"\n", name);
      missing = true;
    }
    messages.flush();
  }
  renderer.finish();
  messages.flush();
  if (arguments.verbosity > 1)
    for (const std::string& name : renderer.written())
      fmt::print("{}\n", name);
  if (!arguments.statistics_file.empty()) {
    std::string why = slvm::write_whole_file(arguments.statistics_file, statistics.data(), statistics.size());
    if (!why.empty()) {
      fmt::print(stderr, "slrender: error: cannot write \"{}\": {}\n", arguments.statistics_file, why);
      return kMissingFile;
    }
  }
  if (!arguments.frames.empty() && !wanted.any() && !missing) {
    fmt::print(stderr,
               "slrender: error: no frame has one of the numbers asked for with -frames or -framelist\n");
    return kWrongInput;
  }
  if (missing) return kMissingFile;
  return messages.failed ? kWrongInput : kFine;
}

} // namespace

int main(int argc, char** argv) {
  render::tools::make_roomy_heap();
  Arguments arguments = render::tools::parse_arguments(argc, argv);
  if (arguments.exit_status) return *arguments.exit_status;
  try {
    return run(arguments);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "slrender: error: there is not enough memory\n");
    return kInternal;
  } catch (const std::exception& e) {
    fmt::print(stderr, "slrender: internal error: {}\n", e.what());
    return kInternal;
  }
}
