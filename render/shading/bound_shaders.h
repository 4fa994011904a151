// The shaders of a scene, loaded and bound before its first grid: every message about them comes up front.
#pragma once

#include "render/shading/shader_loader.h"
#include "render/state/scene.h"
#include "slvm/machine.h"
#include "slvm/support/diagnostics.h"

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace render {

/// Loaded shaders by name, for all frames of a run.
class ShaderCache {
public:
  ShaderCache(const slvm::Machine& machine, ShaderLoader loader)
      : machine_(machine), loader_(std::move(loader)) {}
  /// A failure is remembered: the same file is not read again for each primitive.
  slvm::Result<std::shared_ptr<const slvm::Shader>> find(const std::string& name,
                                                         const std::vector<std::string>& path);

private:
  const slvm::Machine& machine_;
  ShaderLoader loader_;
  std::map<std::pair<std::string, std::vector<std::string>>,
           slvm::Result<std::shared_ptr<const slvm::Shader>>>
      loaded_;
};

/// What one set of attributes shades with.
struct BoundAttributes {
  slvm::ShaderSet shaders;
  std::vector<const slvm::Instance*> lights;
};

class BoundShaders {
public:
  /// Binds everything `scene` refers to. A shader that cannot be had is reported at its request and left out:
  /// its surface is the default one, its light is dark.
  BoundShaders(const Scene& scene, const slvm::Machine& machine, ShaderCache& cache,
               slvm::Diagnostics& diagnostics);

  /// Never null for attributes of the scene.
  const BoundAttributes* find(const Attributes* attributes) const;
  const slvm::Instance* find(const ShaderRequest& request) const;

private:
  class Binder;
  std::unordered_map<const Attributes*, BoundAttributes> attributes_;
  std::unordered_map<const ShaderRequest*, std::unique_ptr<slvm::Instance>> instances_;
};

} // namespace render
