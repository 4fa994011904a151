// The scattering of "Finding Nemo" (E. Tomson, "Human Skin for Finding Nemo", chapter 5 of "RenderMan, Theory
// and Practice", SIGGRAPH 2003 course 9): the kernel (5.1) and the scatter map (5.4), a picture of a mesh
// laid flat whose pixels are samples of its surface. How they get their light: scatter_cache.h.
//
// Positions are in world space, D is a length there.
#pragma once

#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/point_cloud.h"

namespace subsurface {

/// T: what gets from a sample to a point at this distance, a unit of the sample's area [1/length^2]:
/// (1 - smoothstep(0, D, r))/(3 D^2 pi/10). Its integral over the plane is 1, so that D does not change
/// brightness.
float scatter_transmission(float r, float D);

/// B, the bounce attenuation: takes away light that would have to go through air because the surface is
/// concave there. B = 1 - (1 - N.Ni)(1 - N.L)/2 with L = (P - Pi)/D, N and Ni unit; 1 for equal normals. As
/// printed it runs down to -1, which would take light away from others: here it ends at 0.
float bounce_attenuation(Vec3 P, Vec3 Pi, Vec3 N, Vec3 Ni, float D);

/// The samples of a scatter map, in an octree. Not changed once made.
class ScatterMap {
public:
  ScatterMap() = default;
  /// Needs positions, normals and areas; points without area are left out.
  static slvm::Result<ScatterMap> build(const PointCloud& cloud);

  size_t size() const { return area_.size(); }
  const PointOctree& octree() const { return octree_; }
  // In the octree's order:
  Vec3 position(size_t i) const { return octree_.positions()[i]; }
  Vec3 normal(size_t i) const { return normal_[i]; }
  float area(size_t i) const { return area_[i]; }

private:
  PointOctree octree_;
  std::vector<Vec3> normal_;
  std::vector<float> area_;
};

/// The three pictures of a scatter map (5.4), pixel by pixel: positions and normals with three channels,
/// areas with one. Pixels whose area is not above 0, or that hold something that is not finite, show no
/// surface; neither do those that a filter mixed with nothing, whose normals are too short.
slvm::Result<PointCloud> cloud_of_scatter_images(size_t width, size_t height, std::span<const float> position,
                                                 std::span<const float> normal, std::span<const float> area);

} // namespace subsurface
