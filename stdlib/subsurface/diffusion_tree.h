// The second pass of Jensen and Buhler, "A Rapid Hierarchical Rendering Technique for Translucent Materials",
// 2002: light that was gathered at points of a surface, and how much of it leaves at any other point by
// diffusion. Far away points are taken together.
//
// Positions and areas are in the unit of the dipoles' coefficients, all in one space.
#pragma once

#include "stdlib/subsurface/materials.h"
#include "stdlib/subsurface/octree.h"
#include "stdlib/subsurface/point_cloud.h"

#include <limits>

namespace subsurface {

/// Which samples count, by their distance: those between `inner` and `outer`, with weights that rise and fall
/// smoothly over `fade` times each bound, so that shells whose bounds meet share each sample between them. 0:
/// a sharp edge.
struct Shell {
  float inner = 0;
  float outer = std::numeric_limits<float>::infinity();
  float fade = 0;

  float weight(float distance) const;
};

struct LookupOptions {
  /// A group of samples stands for its members if the solid angle under which their area appears, A/d^2, is
  /// at most this (2002, eq 12). 0: the sum over all samples. docs/subsurface.md has the errors.
  float epsilon = 0.05f;
  Shell shell;
  /// Where a group is about to stand for its members, both are taken, in shares that pass smoothly into each
  /// other, so that no edge shows. Costs about half as much again.
  bool smooth = false;
  /// How far, from 0 to 1, light is kept from crossing air where the surface is concave (lips, folds): each
  /// sample counts as much as bounce_attenuation() of scatter_map.h says. Needs the cloud's normals, and
  /// `normals`.
  float follow_topology = 0;
  std::span<const Vec3> normals = {}; ///< unit, at each x
};

/// What lookups cost: how many groups and single samples they summed.
struct LookupCount {
  uint64_t groups = 0, samples = 0;
};

class DiffusionTree;

/// The dipoles of samples and groups: one for all, or by colours of the samples (2001, 4: those at the place
/// where light enters count).
class DiffusionMaterial {
public:
  explicit DiffusionMaterial(const DipoleRgb& dipoles);
  /// From the cloud's albedo (grey where there is none) and the diffuse mean free path [length] of each
  /// colour. A group has the mean of its albedos, weighted by the light.
  DiffusionMaterial(const DiffusionTree& tree, Color mean_free_path, double eta,
                    DiffuseFresnel how = DiffuseFresnel::kFit);

  size_t bytes() const { return (samples_.size() + groups_.size()) * sizeof(Sources); }

private:
  friend class DiffusionTree;
  /// One dipole each for red, green and blue, ready for use.
  struct Sources {
    float gain[3], transport[3], z_real[3], z_virtual[3]; // gain: Fdt alpha'/(4 pi)
  };
  static Sources sources_of(const DipoleRgb& dipoles);

  std::vector<Sources> samples_, groups_; // one each if it is one for all
  bool uniform_;
  float reach_ = 0; // the diffuse mean free path of the colour that gets farthest
};

/// The tree of a cloud. Lookups may run in any number of threads, but not beside set_irradiance().
class DiffusionTree {
public:
  /// Of each node: the sum over its samples.
  struct Group {
    Vec3 position;    ///< mean, weighted by the flux (2002, 3); by area where it is dark
    float area = 0;   ///< A [length^2]
    Color flux;       ///< sum of E times A [power]
    bool dark = true; ///< none of them has light
    Vec3 normal;      ///< mean, weighted as the position is; shorter than 1 where they differ
  };

  DiffusionTree() = default;
  /// Needs position, area and irradiance; the error says what is missing or wrong. The cloud is not needed
  /// any more.
  static slvm::Result<DiffusionTree> build(const PointCloud& cloud);

  /// New light for the same points, in the cloud's order.
  void set_irradiance(std::span<const Color> irradiance);

  /// M, radiant exitance by diffusion at each x [power/length^2]: the sum of Fdt Rd(|x - P|) E A (2002, eq
  /// 13; as printed it divides by alpha' where the dipole source already has it). As radiance:
  /// exitant_radiance(), in which Fdt cancels, as it should, for what it stands for is the transmittance from
  /// outside; without Fresnel terms M/(pi Fdt).
  void exitance(const DiffusionMaterial& material, std::span<const Vec3> x, const LookupOptions& options,
                std::span<Color> out, LookupCount* count = nullptr) const;
  Color exitance(const DiffusionMaterial& material, Vec3 x, const LookupOptions& options = {}) const;

  const PointOctree& octree() const { return octree_; }
  std::span<const Group> groups() const { return groups_; }
  size_t size() const { return flux_.size(); }
  bool has_normals() const { return !normal_.empty(); }
  bool has_albedo() const { return !albedo_.empty(); }
  /// Memory that it takes.
  size_t bytes() const;

  /// A sparser cloud with the same area, flux and mean albedo: each group of the tree that is not larger
  /// across than `size` becomes a point, and so do samples that stand alone. Normals are averaged, channels
  /// are left out.
  PointCloud coarser(float size) const;

private:
  friend class DiffusionMaterial;
  friend class TreeFile; // tree_file.h: on disk
  class Gather;

  void sum_groups();

  PointOctree octree_;
  std::vector<Group> groups_;
  // Of the samples, in the order of the octree:
  std::vector<float> area_;
  std::vector<Color> flux_;
  std::vector<Vec3> normal_;  // may be empty
  std::vector<Color> albedo_; // may be empty
};

/// Several densities of one surface: the finest near x, coarser ones farther away (the course's 4.4).
class CloudLevels {
public:
  struct Level {
    const DiffusionTree* tree;
    const DiffusionMaterial* material;
    float radius; ///< up to where it is used; that of the last does not matter
  };
  /// From fine to coarse, radii rising; the trees and materials must live as long.
  explicit CloudLevels(std::vector<Level> levels) : levels_(std::move(levels)) {}

  /// As DiffusionTree::exitance(). Levels pass into each other over `fade` times the radius, so that no edge
  /// shows.
  void exitance(std::span<const Vec3> x, float epsilon, float fade, std::span<Color> out,
                LookupCount* count = nullptr) const;

private:
  std::vector<Level> levels_;
};

} // namespace subsurface
