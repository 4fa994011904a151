// Ri functions called by a plug-in (Procedural "DynamicLoad") go to the renderer that called it.
#pragma once

#include "render/renderer.h"

#include <functional>
#include <memory>
#include <mutex>

namespace render::ri {

class Context;

class PlugInCalls {
public:
  PlugInCalls();
  ~PlugInCalls();
  /// For RendererSettings::around_plug_in.
  std::function<void(slvm::SourceRange, const std::function<void()>&)> around();
  /// The renderer made with these settings, and where its messages go. This object must outlive its use of
  /// plug-ins.
  void attach(Renderer& renderer, slvm::Diagnostics& diagnostics);

private:
  Context& context();

  std::function<std::unique_ptr<Context>()> make_;
  std::once_flag made_; ///< when it is first needed: most scenes have no plug-ins
  std::unique_ptr<Context> context_;
};

} // namespace render::ri
