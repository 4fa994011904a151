// A context for the plug-ins of a renderer.
#include "render/ri/plug_in_calls.h"

#include "render/ri/context.h"
#include "render/ri/render_backend.h"

namespace render::ri {

PlugInCalls::PlugInCalls() = default;
PlugInCalls::~PlugInCalls() = default;

std::function<void(slvm::SourceRange, const std::function<void()>&)> PlugInCalls::around() {
  return [this](slvm::SourceRange where, const std::function<void()>& functions) {
    context().run(where, functions);
  };
}

void PlugInCalls::attach(Renderer& renderer, slvm::Diagnostics& diagnostics) {
  auto report = [this, &diagnostics](RiError kind, RtInt severity, const std::string& text) {
    if (context_->handler)
      call_handler(context_->handler, kind, severity, text);
    else if (severity >= RIE_ERROR)
      diagnostics.error(context_->where(), text);
    else
      diagnostics.warning(context_->where(), "rib", text);
  };
  make_ = [report, &renderer, &diagnostics] {
    return std::make_unique<Context>(std::make_unique<AttachedBackend>(renderer, diagnostics), report);
  };
}

Context& PlugInCalls::context() {
  std::call_once(made_, [this] { context_ = make_(); });
  return *context_;
}

} // namespace render::ri
