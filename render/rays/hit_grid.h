// Hits of rays as a shading grid. Points are evaluated on the primitive itself, where the ray meets it; where
// shaders differentiate, each hit has two neighbours (slvm::Lattice::kHits), a step along u and one along v,
// as far as the ray's footprint reaches: what origin and direction change by to the neighbouring rays is
// carried over to the surface (Igehy, Tracing Ray Differentials, SIGGRAPH 1999, section 3.1.1). Neighbours
// lie on the tangents, and have only those variables that derivatives depend on (ReadVariables).
#pragma once

#include "render/prims/dice.h"
#include "render/rays/ray_geometry.h"

namespace render {

/// A ray that hit something.
struct HitRay {
  uint32_t ray = 0;   ///< in its batch
  uint32_t slot = 0;  ///< of its values in the outputs
  uint32_t point = 0; ///< of the grid it comes from
  SurfacePlace place;
  float distance = 0, time = 0;
};

/// The rays of a batch, one by one.
struct HitRays {
  const slvm::RayBatch& batch;
  std::span<const Color> weights; ///< parts of the picture that rays make; empty: all of it

  /// They have a width: what origin and direction change by to the neighbours is known.
  bool wide() const { return batch.origin_du[0] && batch.direction_du[0]; }
  Vec3 origin(const HitRay& h) const { return at(batch.origin, h); }
  Vec3 direction(const HitRay& h) const { return at(batch.direction, h); }
  static Vec3 at(const float* const (&planes)[3], const HitRay& h) {
    return {planes[0][h.ray], planes[1][h.ray], planes[2][h.ray]};
  }
};

/// Where a surface is at a point, in camera space, with derivatives by its parameter square.
struct SurfaceSpot {
  Vec3 P, dPdu, dPdv;
};

/// The footprint of a ray on a surface in units of its parameters: what u and v change by to the neighbouring
/// rays.
struct Footprint {
  float ux = 0, vx = 0, uy = 0, vy = 0;
};
Footprint footprint_on(const HitRays& rays, const HitRay& hit, const SurfaceSpot& spot);

class HitGrid {
public:
  slvm::Grid grid{1, 1};

  /// Fills the grid with hits whose primitives can be diced together (dice_geometry); those of one primitive
  /// follow each other, so that its geometry is asked once for all. `beside`: with neighbours.
  void dice(const Scene& scene, const HitRays& rays, std::span<const HitRay> hits, bool beside,
            const DiceContext& context, const ReadVariables& read = {});
  /// To be called around a displacement shader. Afterwards points are back where they were if rays do not see
  /// displacements: the shader then has changed N only.
  void before_displacement();
  void after_displacement(bool moved);

private:
  /// Hits of one primitive, at one time if it moves.
  struct Run {
    const Primitive* primitive;
    size_t first, count;
    bool displaced;
  };
  /// Vectors as planes.
  struct Triples {
    std::vector<float> planes[3];
    void resize(size_t count) {
      for (auto& plane : planes)
        plane.resize(count);
    }
    Vec3 get(size_t k) const { return {planes[0][k], planes[1][k], planes[2][k]}; }
    void set(size_t k, Vec3 p) {
      for (int c = 0; c < 3; ++c)
        planes[c][k] = p[c];
    }
  };
  void find_runs(const Scene& scene, std::span<const HitRay> hits);
  void take_rays(const HitRays& rays, std::span<const HitRay> hits);
  void evaluate(size_t row);
  void dice_run(const Run& run, const ReadVariables& read);
  void find_open(const Run& run);
  void settle(const Run& run, std::span<const HitRay> hits);
  UvPoints points(const Run& run, size_t row) const;
  void find_footprints(const HitRays& rays, std::span<const HitRay> hits);
  void dice_beside(const ReadVariables& read);
  void stretch(const ReadVariables& read);
  void step_along_tangents();
  void set_steps();
  void find_origins(const HitRays& rays, std::span<const HitRay> hits);
  void set_rays(const HitRays& rays, std::span<const HitRay> hits, const ReadVariables& read);
  void aim(size_t points);

  std::vector<Primitive> primitives_; ///< of the runs, as they are at the time of a ray
  Primitive first_;                   ///< the first of them as it is when the shutter opens
  std::vector<Run> runs_;
  std::vector<SurfacePoints> parts_;
  size_t hits_ = 0;
  std::vector<float> u_, v_;   ///< of all points
  SurfaceLattice lattice_;     ///< of hits, and of neighbours that are evaluated
  std::vector<uint32_t> open_; ///< hits that are not where their rays are yet, and where to look next:
  std::vector<float> next_u_, next_v_;
  std::vector<float> u_stretch_, v_stretch_; ///< of a hit: the wanted step by the one that is evaluated
  std::vector<float> footprint_[4], weight_[3];
  Triples origins_; ///< of the rays to all points that have any
  Triples targets_; ///< where the rays of the hits met the faces
  std::vector<float> distances_, off_;
  std::vector<float> saved_;
  SurfaceLattice scratch_;
};

} // namespace render
