// Rendering what a C program requests.
#include "render/ri/render_backend.h"

#include "render/setup/compiling_loader.h"
#include "render/setup/places.h"
#include "render/state/interpreter.h"
#include "slvm/support/shared_library.h"

#include <fmt/format.h>

#include <cstdio>

namespace render::ri {

AttachedBackend::AttachedBackend(Renderer& renderer, slvm::Diagnostics& diagnostics)
    : renderer_(renderer), diagnostics_(diagnostics) {}

void AttachedBackend::request(const RequestCall& call) {
  renderer_.interpreter().request(call);
  deliver();
}

void AttachedBackend::verbatim(const std::string& rib) {
  renderer_.read_text("<RiArchiveRecord>", rib);
  deliver();
}

void AttachedBackend::read_archive(const RequestCall& call,
                                   const std::function<void(std::string_view)>& on_comment) {
  Interpreter& interpreter = renderer_.interpreter();
  auto outer = std::exchange(interpreter.on_comment, on_comment);
  request(call);
  interpreter.on_comment = outer;
}

void AttachedBackend::procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker> maker,
                                 slvm::SourceRange where) {
  renderer_.interpreter().procedural(bound, std::move(maker), where);
  deliver();
}

/// As a box first, which checks place and widths: where that is not carried out, nothing changes.
void AttachedBackend::pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) {
  RequestCall call;
  call.id = RequestId::kPixelFilter;
  call.arguments.resize(3);
  call.arguments[0].strings = {"box"};
  call.arguments[1].numbers = {xwidth};
  call.arguments[2].numbers = {ywidth};
  PixelFilter& filter = renderer_.options().filter;
  PixelFilter before = std::exchange(filter, {FilterKind::kBox, -1, -1});
  request(call);
  if (filter.xwidth > 0)
    filter = {FilterKind::kFunction, xwidth, ywidth, function};
  else
    filter = before;
}

slvm::Result<Matrix4> AttachedBackend::to_camera(const std::string& space) {
  auto matrix = renderer_.interpreter().find_space(space);
  if (!matrix) return slvm::Error{fmt::format("no coordinate system is named \"{}\"", space)};
  return *matrix;
}

void AttachedBackend::update(SizeTracker& tracker) {
  const Interpreter& interpreter = renderer_.interpreter();
  tracker.set_more(&interpreter.declarations());
  if (!interpreter.recording()) tracker.set_steps(interpreter.basis_steps());
}

namespace {

/// What the renderer of a C program needs to live.
struct Owned {
  explicit Owned(RendererSettings settings) : renderer(sources, diagnostics, std::move(settings)) {
    diagnostics.error_limit = 0;
    renderer.interpreter().allow_own_programs = true;
    namespace places = render::setup;
    renderer.set_standard_path("shader",
                               places::search_path("", "ANEMONE_SHADERS", places::standard_shader_folders()));
    renderer.set_standard_path("archive", places::search_path("", "ANEMONE_ARCHIVES", {}));
    renderer.set_standard_path("procedural", places::search_path("", "ANEMONE_PROCEDURALS", {}));
  }

  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Renderer renderer;
};

RendererSettings settings(AroundPlugIn around_plug_in, std::function<void()> flush) {
  RendererSettings s;
  s.around_plug_in = std::move(around_plug_in);
  s.procedural_folders = render::setup::procedural_folders("", "ANEMONE_PROCEDURALS");
  s.plugin_folders = slvm::plugin_folders("");
  s.shader_loader = render::setup::make_compiling_loader(
      "ri", [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); },
      s.plugin_folders);
  s.print = [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); };
  s.flush_messages = std::move(flush);
  return s;
}

/// A renderer of its own, whose messages go to the program's error handler.
class RenderBackend : private Owned, public AttachedBackend {
public:
  explicit RenderBackend(AroundPlugIn around_plug_in)
      : Owned(settings(std::move(around_plug_in), [this] { deliver(); })),
        AttachedBackend(Owned::renderer, Owned::diagnostics) {}

  void finish() override {
    renderer_.finish();
    deliver();
  }

private:
  void deliver() override;
  std::string describe(const slvm::Diagnostic& d) const;
  std::string place(slvm::SourceRange where) const;
};

std::string RenderBackend::place(slvm::SourceRange where) const {
  return where.valid() ? fmt::format("{}:{}:{}: ", sources.name(where.file), where.line, where.column) : "";
}

std::string RenderBackend::describe(const slvm::Diagnostic& d) const {
  std::string out = place(d.where) + d.text;
  for (const slvm::Note& n : d.notes)
    if (n.where.valid()) out += fmt::format("; {}{}", place(n.where), n.text);
  return out;
}

/// Handlers may do anything, also make requests: the list is emptied first.
void RenderBackend::deliver() {
  std::vector<slvm::Diagnostic> list;
  diagnostics_.for_each([&](slvm::Diagnostic& d) { list.push_back(std::move(d)); });
  if (list.empty()) return;
  diagnostics_ = {};
  diagnostics_.error_limit = 0;
  RiError kind = renderer_.interpreter().take_error_kind();
  if (kind == RiError::kNone) kind = RiError::kConsistency;
  for (const slvm::Diagnostic& d : list) {
    bool warning = d.severity != slvm::Severity::kError;
    RiError of_warning =
        d.warning_name == "rib-unsupported" ? RiError::kUnimplemented : RiError::kConsistency;
    report(warning ? of_warning : kind, warning ? RIE_WARNING : RIE_ERROR, describe(d));
  }
}

} // namespace

std::unique_ptr<Backend> make_render_backend(AroundPlugIn around_plug_in) {
  return std::make_unique<RenderBackend>(std::move(around_plug_in));
}

} // namespace render::ri
