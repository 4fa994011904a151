// Contexts that render.
#pragma once

#include "render/renderer.h"
#include "render/ri/backend.h"

namespace render::ri {

/// Leads requests to a renderer that somebody else owns, and messages to that one's diagnostics.
class AttachedBackend : public Backend {
public:
  AttachedBackend(Renderer& renderer, slvm::Diagnostics& diagnostics);

  void request(const RequestCall& call) override;
  void comment(const std::string&) override {}
  void verbatim(const std::string& rib) override;
  void read_archive(const RequestCall& call,
                    const std::function<void(std::string_view)>& on_comment) override;
  void procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker> maker,
                  slvm::SourceRange where) override;
  void pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) override;
  slvm::Result<Matrix4> to_camera(const std::string& space) override;
  void update(SizeTracker& tracker) override;
  void finish() override {}

protected:
  /// After each call of the renderer.
  virtual void deliver() {}

  Renderer& renderer_;
  slvm::Diagnostics& diagnostics_;
};

/// Calls a plug-in's functions with the context as the current one.
using AroundPlugIn = std::function<void(slvm::SourceRange, const std::function<void()>&)>;

/// A context that renders in this process. Folders come from the environment as those of slrender do.
std::unique_ptr<Backend> make_render_backend(AroundPlugIn around_plug_in);

} // namespace render::ri
