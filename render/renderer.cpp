// The steps of a frame, from scene to files.
#include "render/renderer.h"

#include "render/display/output.h"
#include "render/hider/frame.h"
#include "render/shading/vm_shading.h"
#include "render/state/interpreter.h"
#include "render/texture/texture_maps.h"

#include <fmt/format.h>

#include <set>
#include <tuple>

namespace render {

struct Renderer::Impl {
  Impl(slvm::SourceManager& sources, slvm::Diagnostics& d, RendererSettings s)
      : diagnostics(d), settings(std::move(s)), cache(machine, settings.shader_loader),
        interpreter(sources, d, [this](Scene& scene) { render(scene); }) {
    interpreter.override_options = settings.override_options;
    interpreter.allow_programs = settings.allow_programs;
    interpreter.program_limits.seconds = settings.program_seconds;
  }

  void render(Scene& scene);
  void report_runtime_messages();
  void flush() {
    if (settings.flush_messages) settings.flush_messages();
  }

  slvm::Diagnostics& diagnostics;
  RendererSettings settings;
  slvm::Machine machine;
  ShaderCache cache;
  Interpreter interpreter;
  std::vector<std::string> written;
  /// Run-time messages already shown, by file, line, shader and text.
  std::set<std::tuple<std::string, uint32_t, std::string, std::string>> shown;
};

namespace {

TextureMaps::Settings texture_settings(const Options& options) {
  TextureMaps::Settings s;
  if (auto it = options.search_paths.find("texture"); it != options.search_paths.end())
    for (const std::string& folder : it->second)
      s.search_path += folder + ":";
  s.search_path += ".";
  if (auto it = options.named.find("shadow:bias");
      it != options.named.end() && it->second.numbers.size() == 1)
    s.shadow_bias = it->second.numbers[0];
  return s;
}

} // namespace

void Renderer::Impl::render(Scene& frame) {
  if (frame.options.displays.empty()) frame.options.displays.push_back({"ri.tif", "file", "rgba", {}, {}});
  FrameSettings s;
  s.threads = settings.threads;
  s.aovs = display_aovs(frame.options, diagnostics);
  s.progress = settings.progress;
  BoundShaders shaders(frame, machine, cache, diagnostics);
  flush();
  if (s.progress) s.progress(0);
  TextureMaps textures(texture_settings(frame.options));
  SceneServices services(frame, shaders, textures, settings.print);
  VmShading shading(machine, shaders, services);
  FrameReport report;
  Image image = render_frame(frame, shading, s, report);
  report_runtime_messages();
  if (report.bad_colours > 0)
    diagnostics.warning({}, "nan",
                        fmt::format("{} shading points have a colour that is not a finite number; "
                                    "they are drawn black",
                                    report.bad_colours));
  for (std::string& name : write_displays(frame, image, s.aovs, diagnostics))
    written.push_back(std::move(name));
  flush();
}

/// The machine's own "file:line: text (shader, n of m points)", each once.
void Renderer::Impl::report_runtime_messages() {
  for (const slvm::RuntimeMessage& m : machine.messages()) {
    if (!shown.emplace(m.file, m.line, m.shader, m.text).second) continue;
    std::string text =
        fmt::format("{}:{}: {} ({}, {} of {} points)", m.file, m.line, m.text, m.shader, m.points, m.total);
    if (m.severity == slvm::MessageSeverity::kError)
      diagnostics.error({}, text);
    else
      diagnostics.warning({}, "runtime", text);
  }
}

Renderer::Renderer(slvm::SourceManager& sources, slvm::Diagnostics& diagnostics, RendererSettings settings)
    : impl_(std::make_unique<Impl>(sources, diagnostics, std::move(settings))) {}

Renderer::~Renderer() = default;

bool Renderer::read_file(const std::string& name) {
  return impl_->interpreter.read_file(name);
}
void Renderer::read_text(std::string name, std::string text) {
  impl_->interpreter.read_text(std::move(name), std::move(text));
}
void Renderer::finish() {
  impl_->interpreter.finish();
}
Options& Renderer::options() {
  return impl_->interpreter.options();
}
void Renderer::set_standard_path(const std::string& kind, std::vector<std::string> directories) {
  impl_->interpreter.options().search_paths[kind] = directories;
  impl_->interpreter.standard_paths[kind] = std::move(directories);
}
const std::vector<std::string>& Renderer::written() const {
  return impl_->written;
}

} // namespace render
