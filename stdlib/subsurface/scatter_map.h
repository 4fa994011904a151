// The scattering of "Finding Nemo" (E. Tomson, "Human Skin for Finding Nemo", chapter 5 of "RenderMan, Theory
// and Practice", SIGGRAPH 2003 course 9): the kernel (5.1) and the scatter map (5.4), a picture of a mesh
// laid flat whose pixels are samples of its surface. How they get their light: scatter_cache.h.
//
// Positions are in world space, D is a length there.
#pragma once

#include "stdlib/subsurface/face_map.h"
#include "stdlib/subsurface/octree.h"

#include <optional>

namespace subsurface {

/// T: what gets from a sample to a point at this distance, a unit of the sample's area [1/length^2]:
/// (1 - smoothstep(0, D, r))/(3 D^2 pi/10). Its integral over the plane is 1, so that D does not change
/// brightness.
float scatter_transmission(float r, float D);

/// B, the bounce attenuation: takes away light that would have to go through air because the surface is
/// concave there. B = 1 - (1 - N.Ni)(1 - N.L)/2 with L = (P - Pi)/D, N and Ni unit; 1 for equal normals. As
/// printed it runs down to -1, which would take light away from others: here it ends at 0.
float bounce_attenuation(Vec3 P, Vec3 Pi, Vec3 N, Vec3 Ni, float D);

/// The samples of a scatter map, in an octree or by faces. Not changed once made; copies share the faces.
class ScatterMap {
public:
  /// The channel of clouds that says which face of a mesh each point is on.
  static constexpr const char* kFaceChannel = "face";

  ScatterMap() = default;
  /// Needs positions, normals and areas; points without area are left out. With a pool, and if the cloud says
  /// the faces: by faces, whose samples live in the pool.
  static slvm::Result<ScatterMap> build(const PointCloud& cloud, std::shared_ptr<BlockPool> pool = nullptr);

  size_t size() const { return faces_ ? faces_->size() : area_.size(); }
  const FaceMap* faces() const { return faces_.get(); } ///< null: it is an octree
  // Of an octree, in its order; ScatterReader reads both.
  const PointOctree& octree() const { return octree_; }
  Vec3 position(size_t i) const { return octree_.positions()[i]; }
  Vec3 normal(size_t i) const { return normal_[i]; }
  float area(size_t i) const { return area_[i]; }
  /// Memory that it takes, but for samples in a pool.
  size_t bytes() const;

private:
  static ScatterMap by_faces(std::vector<ScatterSample> samples, const std::vector<float>& faces,
                             std::shared_ptr<BlockPool> pool);

  PointOctree octree_;
  std::vector<Vec3> normal_;
  std::vector<float> area_;
  std::shared_ptr<const FaceMap> faces_;
};

/// What one thread reads of a map. What it has read stays in memory until forget().
class ScatterReader {
public:
  explicit ScatterReader(const ScatterMap& map) : map_(&map) {
    if (map.faces()) faces_.emplace(*map.faces());
  }
  ScatterSample sample(uint32_t i) {
    if (faces_) return faces_->sample(i);
    return {map_->position(i), map_->normal(i), map_->area(i)};
  }
  /// As PointOctree::for_each_within().
  template <class F> void for_each_within(Vec3 x, float D, F&& f) {
    if (faces_)
      faces_->for_each_within(x, D, f);
    else
      map_->octree().for_each_within(x, D, f);
  }
  void forget() {
    if (faces_) faces_->forget();
  }

private:
  const ScatterMap* map_;
  std::optional<FaceReader> faces_;
};

/// The pictures of a scatter map (5.4), pixel by pixel: positions and normals with three channels, areas with
/// one; and numbers of faces with one, or nothing (5.5), for the channel "face". Pixels whose area is not
/// above 0, or that hold something that is not finite, show no surface; neither do those that a filter mixed
/// with nothing, whose normals are too short.
slvm::Result<PointCloud> cloud_of_scatter_images(size_t width, size_t height, std::span<const float> position,
                                                 std::span<const float> normal, std::span<const float> area,
                                                 std::span<const float> face = {});

} // namespace subsurface
