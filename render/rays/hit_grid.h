// Hits of rays as a shading grid. Points are evaluated on the primitive itself, where the ray meets it; where
// shaders differentiate, each hit has two neighbours (slvm::Lattice::kHits), a step along u and one along v,
// as far as the ray's footprint reaches: what origin and direction change by to the neighbouring rays is
// carried over to the surface (Igehy, Tracing Ray Differentials, SIGGRAPH 1999, section 3.1.1).
#pragma once

#include "render/prims/dice.h"
#include "render/rays/ray_geometry.h"

#include <deque>

namespace render {

/// A ray that hit something.
struct HitRay {
  uint32_t ray = 0;   ///< in its batch
  uint32_t point = 0; ///< of the grid it comes from
  SurfacePlace place;
  float distance = 0, time = 0;
  Vec3 origin, direction;
  bool wide = false; ///< the following say something
  Vec3 origin_dx{0.0f}, origin_dy{0.0f}, direction_dx{0.0f}, direction_dy{0.0f};
  Color weight{1.0f};
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
Footprint footprint_on(const HitRay& ray, const SurfaceSpot& spot);

class HitGrid {
public:
  slvm::Grid grid{1, 1};

  /// Fills the grid with hits whose primitives can be diced together (dice_points); those of one primitive
  /// follow each other, so that its geometry is asked once for all. `beside`: with neighbours. `is_read`: the
  /// primitive variables somebody wants; empty: all.
  void dice(const Scene& scene, std::span<const HitRay> hits, bool beside, const DiceContext& context,
            const VarFilter& is_read = {});
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
  void find_runs(const Scene& scene, std::span<const HitRay> hits);
  void find_spots(const Run& run, std::span<const HitRay> hits);
  void settle(const Run& run, std::span<const HitRay> hits);
  void evaluate_beside(const Run& run);
  UvPoints points(const Run& run, size_t row) const;
  void take_footprints(std::span<const HitRay> hits);
  void stretch(size_t hits);
  void set_steps(size_t hits);
  void set_rays(std::span<const HitRay> hits);
  void aim();

  std::deque<Primitive> moved_; ///< primitives as they are at the time of a ray
  std::vector<Run> runs_;
  std::vector<SurfacePoints> parts_;
  size_t hits_ = 0;
  std::vector<float> u_, v_;   ///< of all points
  SurfaceLattice lattice_;     ///< of all points
  std::vector<uint32_t> open_; ///< hits that are not where their rays are yet, and where to look next:
  std::vector<float> next_u_, next_v_;
  std::vector<float> u_stretch_, v_stretch_; ///< of a hit: the wanted step by the one that is evaluated
  std::vector<float> footprint_[4], weight_[3];
  std::vector<Vec3> origins_; ///< of all points
  std::vector<float> saved_;
  SurfaceLattice scratch_;
};

} // namespace render
