// All that running shaders ask of a renderer. PUBLIC, abstract: the renderer implements it, sltest does with
// a small in-memory scene, and so can an embedder. Calls come from many threads at once, each for one whole
// grid.
//
// "current" is the space of every geometric value on a grid; the VM itself knows "current", "shader" (of the
// instance) and "object" (of the grid) and asks here for the others.
#pragma once

#include "slvm/grid.h"
#include "slvm/irradiance_cache.h"
#include "slvm/photon_map.h"
#include "slvm/point_clouds.h"
#include "slvm/rays.h"
#include "slvm/subsurface.h"
#include "slvm/textures.h"

#include <span>
#include <string_view>

namespace slvm {

class Instance;

/// The shaders that are bound to one primitive. Any may be null.
struct ShaderSet {
  const Instance* displacement = nullptr;
  const Instance* surface = nullptr;
  const Instance* atmosphere = nullptr;
  const Instance* interior = nullptr;
  const Instance* exterior = nullptr;
};

/// What is being shaded, for queries that depend on it.
struct ShadingState {
  const Grid& grid;
  const ShaderSet& shaders;
  const Instance& running; ///< the shader that asks
};

enum class MessageSeverity : uint8_t { kWarning, kError };

/// A run-time message: kept once for each shader, line and text, with the number of points concerned.
struct RuntimeMessage {
  MessageSeverity severity = MessageSeverity::kError;
  std::string file; ///< of the RSL source
  uint32_t line = 0;
  std::string shader; ///< e.g. surface "plastic"
  std::string text;
  uint64_t points = 0, total = 0; ///< points concerned, of all the points the statement ran for
  uint64_t times = 1;             ///< how often it was reported: grids, and rounds of loops
};

class RendererServices {
public:
  virtual ~RendererServices() = default;

  /// The matrix from a named space to "current" and back. "world", "camera", "screen", "raster", "NDC" and
  /// whatever the scene names. Projective spaces give projective matrices. False: no such space; `m` is then
  /// not read.
  virtual bool space_to_current(const ShadingState&, std::string_view space, Matrix4& m) = 0;
  virtual bool current_to_space(const ShadingState&, std::string_view space, Matrix4& m) = 0;

  /// Light shader instances that are on for this primitive, in order of declaration. The span and the
  /// instances live until the grid is done.
  virtual std::span<const Instance* const> lights(const ShadingState&) = 0;

  /// Queries by name ("Sides", "user:...", "Ri:Matte"). False: unknown name. The VM checks the type.
  virtual bool attribute(const ShadingState&, std::string_view name, Value& out) = 0;
  virtual bool option(const ShadingState&, std::string_view name, Value& out) = 0;
  virtual bool renderer_info(const ShadingState&, std::string_view name, Value& out) = 0;

  /// Who looks up textures; null: nobody, and every lookup is a run-time message.
  virtual TextureServices* textures() { return nullptr; }

  /// Who traces rays; null: nobody, and rays hit nothing, with a run-time message.
  virtual RayServices* rays() { return nullptr; }

  /// Who looks up clouds of lit points; null: nobody, and nothing comes from below surfaces, with a run-time
  /// message.
  virtual SubsurfaceServices* subsurface() { return nullptr; }

  /// Who writes and reads files of points for plug-ins; null: nobody, which a run-time message says.
  virtual PointCloudServices* point_clouds() { return nullptr; }

  /// Who keeps irradiance caches; null: nobody, and irradiancecache() finds nothing, with a run-time message.
  virtual IrradianceCacheServices* irradiance_caches() { return nullptr; }

  /// Who looks up photon maps; null: nobody, and photonmap() is black, with a run-time message.
  virtual PhotonMapServices* photon_maps() { return nullptr; }

  /// Text of printf, in order within one grid, as it is printed. Warnings and errors of running shaders go
  /// another way: MachineOptions::on_message.
  virtual void print(const ShadingState&, std::string_view text) = 0;
};

} // namespace slvm
