// The shaders of a scene, loaded and bound before its first grid: every message about them comes up front.
#pragma once

#include "render/shading/shader_loader.h"
#include "render/state/scene.h"
#include "slvm/machine.h"
#include "slvm/support/diagnostics.h"

#include <bitset>
#include <map>
#include <memory>
#include <set>
#include <shared_mutex>
#include <span>
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
  std::shared_ptr<const Attributes> attributes;
  slvm::ShaderSet shaders;
  std::vector<const slvm::Instance*> lights;
  /// The predefined variables that surface, atmosphere, volumes and lights read, and the defaults of their
  /// parameters; all that a plug-in may ask for. Displacement may need more: it makes geometry anew.
  std::bitset<slvm::kGlobalCount> read;
  /// Each point of a grid is shaded by itself: what shading gives there does not depend on which others there
  /// are, and shading a point does nothing else.
  bool point_by_point = false;
  /// Shading does more than give colours: it writes files, prints, or calls plug-ins, which may do anything.
  bool has_effects = false;
  bool same_as(const BoundAttributes& b) const {
    return shaders.displacement == b.shaders.displacement && shaders.surface == b.shaders.surface &&
           shaders.atmosphere == b.shaders.atmosphere && shaders.interior == b.shaders.interior &&
           shaders.exterior == b.shaders.exterior && lights == b.lights;
  }
};

class BoundShaders {
public:
  /// Binds everything `scene` refers to. A shader that cannot be had is reported at its request and left out:
  /// its surface is the default one, its light is dark.
  BoundShaders(const Scene& scene, const slvm::Machine& machine, ShaderCache& cache,
               slvm::Diagnostics& diagnostics);
  /// Binds what further primitives refer to. One call at a time; other threads may go on asking.
  void add(const PrimitiveList& primitives);

  /// Never null for attributes of the scene. What it points to stays.
  const BoundAttributes* find(const Attributes* attributes) const;
  const slvm::Instance* find(const ShaderRequest& request) const;

private:
  class Binder;
  void find_emitters(const PrimitiveList& primitives);
  /// A request bound for primitives whose variables may replace these parameters. Where later ones have more,
  /// it is bound again; pictures do not depend on which is used.
  struct BoundRequest {
    std::set<std::string> may_vary;
    std::unique_ptr<slvm::Instance> instance;
  };
  const Options& options_;
  const slvm::Machine& machine_;
  ShaderCache& cache_;
  slvm::Diagnostics& diagnostics_;
  std::set<std::string> missing_;   ///< shaders that were reported
  mutable std::shared_mutex mutex_; ///< of the maps; nothing is ever taken out of the lists
  std::unordered_map<const Attributes*, std::vector<std::unique_ptr<const BoundAttributes>>> attributes_;
  std::unordered_map<const ShaderRequest*, std::vector<BoundRequest>> instances_;
  std::unordered_map<const ShaderRequest*, std::shared_ptr<const slvm::LightEmitter>> emitters_;
};

} // namespace render
