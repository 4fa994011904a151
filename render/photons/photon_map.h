// Photon maps: where light arrives on diffuse surfaces (H. W. Jensen, Realistic Image Synthesis Using Photon
// Mapping, 2001; Christensen, "Global Illumination and All That", 3.5; chapter 3 of the SIGGRAPH 2003 course
// 9). In "world" space.
//
// Power is in units of what lights send: a light with Cl on a surface brings Cl times the cosine to each unit
// of its area. So densities of power are what diffuse() returns, and times the surface's colour the radiance
// of it.
#pragma once

#include "render/caches/point_table.h"
#include "render/state/math.h"
#include "stdlib/subsurface/octree.h"

namespace render {

struct Photon {
  Vec3 P{0.0f}, N{0.0f}; ///< N of length 1, the side that it came to
  Vec3 direction{0.0f};  ///< it came along
  Color power{0.0f};     ///< as it arrived
  Color radiance{0.0f};  ///< that leaves the surface here, of all photons near it
  float depth = 0;       ///< how often it was scattered before
};

PointTable table_of(std::span<const Photon> photons);
/// Fails on tables that are something else, and on numbers that cannot be. Errors begin with `name`.
slvm::Result<std::vector<Photon>> photons_of(const PointTable& table, const std::string& name);

/// Not changed once made: any number of threads may look.
class PhotonMap {
public:
  explicit PhotonMap(std::vector<Photon> photons);

  struct Place {
    Vec3 P{0.0f}, N{0.0f}; ///< N of length 1; 0: photons of all sides count
    size_t photons = 50;
    float max_distance = kInfinity;
    float min_depth = 0;
  };
  /// Light per area: the power of the nearest photons but the farthest of them, by the circle through that
  /// one (which makes the mean right; Mack and Rosenblatt, Multivariate k-Nearest Neighbor Density Estimates,
  /// 1979). Those of other sides leave their part of the circle dark.
  Color irradiance(const Place& place) const;
  /// The radiance of the nearest photon of the same side; black when there is none among those near.
  Color radiance(Vec3 P, Vec3 N) const;

  std::span<const Photon> photons() const { return photons_; }
  /// Computes the radiance of all photons: `colour` and `estimator` of each, by its place in photons().
  void compute_radiance(std::span<const Color> colour, std::span<const int> estimator);
  /// Where the photon that was given as number i stands now.
  std::span<const uint32_t> order() const { return tree_.order(); }

private:
  std::vector<Photon> photons_; ///< in the order of the tree
  subsurface::PointOctree tree_;
};

} // namespace render
