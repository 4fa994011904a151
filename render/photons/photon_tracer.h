// Photons on their way through the scene: from the lights, off and through surfaces, into photon maps.
//
// At each surface its shading model (Attribute "photon") and its colour say what becomes of a photon, by
// Russian roulette (Arvo and Kirk, Particle Transport and Image Synthesis, 1990): it goes on with the
// probability of the greatest channel of its power times the colour, by that of its power, and is absorbed
// otherwise; so its greatest channel stays as it is. What is random is a function of the photon's number.
#pragma once

#include "render/photons/light_emission.h"
#include "render/photons/photon_map.h"
#include "render/rays/ray_tracer.h"

#include <map>

namespace render {

/// What became of the photons of a frame.
struct PhotonReport {
  size_t emitted = 0, stored = 0;
  Color power{0.0f};    ///< of all that were emitted
  Color absorbed{0.0f}; ///< at surfaces, and where they were scattered too often
  Color escaped{0.0f};  ///< out of the scene
  std::vector<std::string> problems;
};
/// A line of text.
std::string format_text(const PhotonReport&);

class PhotonTracer {
public:
  /// All arguments must outlive this. The tracer must show what photons see (RayTracer::show_to_photons).
  PhotonTracer(const Scene& scene, const slvm::Machine& machine, const BoundShaders& shaders,
               slvm::RendererServices& services, RayTracer& rays);

  /// Emits so many photons, shared out among the lights by their power.
  PhotonReport run(size_t photons);
  /// Writes the maps of all names that surfaces gave, radiance computed; what went wrong.
  std::vector<std::string> write();
  /// By name; radiance is not computed before write().
  struct Map {
    std::vector<Photon> photons;
    std::vector<Color> colour; ///< of the surface, for each
    std::vector<int> estimator;
  };
  const std::map<std::string, Map>& maps() const { return maps_; }

private:
  struct Flying;
  struct Hits;
  struct Batch;
  std::vector<const slvm::Instance*> lights() const;
  void trace(Batch& batch, const slvm::ShadingState& state) const;
  bool scatter(Flying& photon, const Hits& hits, size_t i, Batch& batch) const;

  const Scene& scene_;
  const slvm::Machine& machine_;
  const BoundShaders& shaders_;
  slvm::RendererServices& services_;
  RayTracer& rays_;
  Matrix4 to_world_;
  std::map<std::string, Map> maps_;
};

} // namespace render
