// A renderer that has nothing: no spaces, lights, attributes or options.
#pragma once

#include "slvm/renderer_services.h"

namespace slvm {

class NoScene : public RendererServices {
public:
  bool space_to_current(const ShadingState&, std::string_view, Matrix4&) override { return false; }
  bool current_to_space(const ShadingState&, std::string_view, Matrix4&) override { return false; }
  std::span<const Instance* const> lights(const ShadingState&) override { return {}; }
  bool attribute(const ShadingState&, std::string_view, Value&) override { return false; }
  bool option(const ShadingState&, std::string_view, Value&) override { return false; }
  bool renderer_info(const ShadingState&, std::string_view, Value&) override { return false; }
  void print(const ShadingState&, std::string_view) override {}
};

} // namespace slvm
