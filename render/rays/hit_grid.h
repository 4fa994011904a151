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
  SurfaceValue object; ///< the same in object space
};
SurfaceSpot evaluate_spot(const Primitive& primitive, float u, float v, SurfaceLattice& scratch);

/// The footprint of a ray on a surface in units of its parameters: what u and v change by to the neighbouring
/// rays.
struct Footprint {
  float ux = 0, vx = 0, uy = 0, vy = 0;
};
Footprint footprint_on(const HitRay& ray, const SurfaceSpot& spot);

class HitGrid {
public:
  slvm::Grid grid{1, 1};

  /// Fills the grid with hits whose primitives can be diced together (dice_points). `beside`: with
  /// neighbours.
  void dice(const Scene& scene, std::span<const HitRay> hits, bool beside, const DiceContext& context);
  /// To be called around a displacement shader. Afterwards points are back where they were if rays do not see
  /// displacements: the shader then has changed N only.
  void before_displacement();
  void after_displacement(bool moved);

private:
  void find_spots(const Scene& scene, std::span<const HitRay> hits);
  void take_footprints(std::span<const HitRay> hits);
  void stretch(size_t hits);
  void set_steps(size_t hits);
  void set_rays(std::span<const HitRay> hits);
  void aim(size_t lane);

  std::deque<Primitive> moved_; ///< primitives as they are at the time of a ray
  std::vector<const Primitive*> primitives_;
  std::vector<SurfaceSpot> spots_;
  std::vector<float> u_, v_;                 ///< of all points
  std::vector<float> u_stretch_, v_stretch_; ///< of a hit: the wanted step by the one that is evaluated
  std::vector<float> footprint_[4], weight_[3];
  std::vector<Vec3> origins_; ///< of all points
  std::vector<float> saved_;
  SurfaceLattice scratch_;
};

} // namespace render
