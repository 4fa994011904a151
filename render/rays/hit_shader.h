// Runs the shaders of what rays hit: hits are put in order of their shaders and primitives, shaded as grids
// of a few hundred points, and what the rays' shader wants to know is taken from these grids.
#pragma once

#include "render/rays/hit_order.h"
#include "render/rays/hit_volumes.h"
#include "render/shading/quiet_services.h"
#include "render/shading/services.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace render {

/// What is the same for all hits of a batch.
struct HitBatch {
  const slvm::ShadingState& from; ///< whose rays they are
  HitRays rays;
  slvm::RayKind kind = slvm::RayKind::kSpecular;
  slvm::HitMode mode = slvm::HitMode::kDefault;
  bool shades = true;   ///< false: shaders do not run
  slvm::RayFacts facts; ///< of the grids
  uint64_t seed = 0;    ///< of the grids' numbers
};

class PhotonMap;
class PhotonMaps;

class HitShader final : public Displacer {
public:
  /// All arguments must outlive this. `services` is what shaders at hits ask; `quiet` the same without rays,
  /// for displacement shaders that run while faces are made.
  HitShader(const Scene& scene, const Camera& camera, const slvm::Machine& machine,
            const BoundShaders& shaders, slvm::RendererServices& services);
  ~HitShader() override;

  /// Photon maps that diffuse rays take the light of surfaces from (Attribute "photon" "globalmap"); null:
  /// none.
  void set_photon_maps(PhotonMaps* maps) { photon_maps_ = maps; }

  /// Shades hits and stores the outputs of each at its ray.
  void shade(std::span<const HitRay> hits, const HitBatch& batch, std::span<const slvm::RayOutput> outputs);

  /// An empty list for the hits of a batch, whose memory is used again: thousands of hits are given back to
  /// the system by each batch otherwise.
  std::vector<HitRay> take_list();
  void give_back(std::vector<HitRay> list);

  bool displaces(const Primitive&) const override;
  void positions(const Primitive&, const UvRect&, int nu, int nv, std::vector<Vec3>& P) override;

  /// Grids and points shaded so far, neighbours included.
  struct Usage {
    size_t grids = 0, points = 0;
  };
  Usage usage() const { return {grids_, points_}; }

private:
  struct Worker;
  class WorkerLease;
  struct Demand;
  struct Work;
  void shade_grid(Worker& worker, std::span<const HitRay> hits, const HitBatch& batch,
                  std::span<const slvm::RayOutput> outputs, const Demand& demand, const Work& work,
                  uint64_t id);
  void prepare(const Primitive& primitive, const HitBatch& batch, std::span<const slvm::RayOutput> outputs,
               const Demand& demand, Work& work);
  const slvm::Instance* narrowed(const slvm::Instance* surface, std::span<const slvm::RayOutput> outputs);
  static std::bitset<slvm::kGlobalCount> read_of_grids(const Work& work, const BoundAttributes& bound,
                                                       std::span<const slvm::RayOutput> outputs);
  bool is_primitive_mode(const Primitive&, const HitBatch& batch) const;
  const slvm::ShaderSet& set_of(const Primitive&) const;
  void take_attributes(const HitBatch& batch, const slvm::Grid& grid, const slvm::ShaderSet& set,
                       std::span<const HitRay> hits, std::span<const slvm::RayOutput> outputs);

  const Scene& scene_;
  const slvm::Machine& machine_;
  const BoundShaders& shaders_;
  slvm::RendererServices& services_;
  PhotonMaps* photon_maps_ = nullptr;
  QuietServices quiet_;
  DiceContext dice_;
  std::mutex workers_mutex_;
  std::vector<std::unique_ptr<Worker>> idle_, idle_displacers_;
  std::vector<std::vector<HitRay>> lists_;
  HitGroups groups_;
  /// Surfaces of which only some outputs are wanted, by instance and names; null: all of it is needed.
  using Narrow = std::map<std::pair<uint64_t, std::string>, std::unique_ptr<const slvm::Instance>>;
  std::mutex narrow_mutex_;
  Narrow narrow_;
  std::atomic<size_t> grids_{0}, points_{0};
};

} // namespace render
