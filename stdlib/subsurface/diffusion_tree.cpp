#include "stdlib/subsurface/diffusion_tree.h"

#include "stdlib/subsurface/dipole_block.h"
#include "stdlib/subsurface/parallel.h"

#include <cassert>
#include <fmt/format.h>
#include <numbers>

namespace subsurface {
namespace {

float smooth(float low, float high, float x) {
  if (x <= low) return 0;
  if (x >= high) return 1;
  const float y = (x - low) / (high - low);
  return y * y * (3 - 2 * y);
}

/// Of a group that could stand for its members: which part it takes where lookups are smooth. `share`: the
/// solid angle of its area over the greatest one.
float part_of_group(float share) {
  return 1 - smooth(0.5f, 1, share);
}

/// Mean over the colours of light that is not negative, the weight of a place.
float weight_of(Color flux) {
  return std::abs(flux.x) + std::abs(flux.y) + std::abs(flux.z);
}

} // namespace

float Shell::weight(float distance) const {
  float w = 1;
  if (inner > 0) w = fade > 0 ? smooth(inner * (1 - fade), inner * (1 + fade), distance) : distance >= inner;
  if (std::isfinite(outer))
    w *= fade > 0 ? 1 - smooth(outer * (1 - fade), outer * (1 + fade), distance) : distance < outer;
  return w;
}

DiffusionMaterial::Sources DiffusionMaterial::sources_of(const DipoleRgb& dipoles) {
  Sources s;
  for (size_t c = 0; c < 3; ++c) {
    if (!std::isfinite(dipoles[c].z_virtual)) { // empty space returns nothing
      s.gain[c] = s.transport[c] = 0, s.z_real[c] = s.z_virtual[c] = 1;
      continue;
    }
    s.gain[c] = static_cast<float>(dipoles[c].fdt * dipoles[c].reduced_albedo / (4 * std::numbers::pi));
    s.transport[c] = static_cast<float>(dipoles[c].effective_transport);
    s.z_real[c] = static_cast<float>(dipoles[c].z_real);
    s.z_virtual[c] = static_cast<float>(dipoles[c].z_virtual);
  }
  return s;
}

namespace {

/// 1/sigma_tr of the colour that gets farthest; without absorption it is without end.
float reach_of(const float (&transport)[3]) {
  const float least = std::min({transport[0], transport[1], transport[2]});
  return least > 0 ? 1 / least : std::numeric_limits<float>::infinity();
}

} // namespace

DiffusionMaterial::DiffusionMaterial(const DipoleRgb& dipoles)
    : samples_{sources_of(dipoles)}, uniform_(true), reach_(reach_of(samples_[0].transport)) {}

DiffusionMaterial::DiffusionMaterial(const DiffusionTree& tree, Color mean_free_path, double eta,
                                     DiffuseFresnel how)
    : uniform_(false) {
  auto sources = [&](Color albedo) {
    return sources_of(dipole_of(medium_of(albedo, mean_free_path, 0, eta, how), how));
  };
  samples_.resize(tree.size());
  parallel_ranges(tree.size(), 0, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      samples_[i] = sources(tree.albedo_.empty() ? Color{0.5f, 0.5f, 0.5f} : tree.albedo_[i]);
  });
  const auto nodes = tree.octree_.nodes();
  groups_.resize(nodes.size());
  auto make_group = [&](size_t n) {
    const PointOctree::Node& node = nodes[n];
    Color sum, weights, plain;
    for (uint32_t i = node.begin; i < node.end && !tree.albedo_.empty(); ++i) {
      const Color flux = tree.flux_[i], weight{std::abs(flux.x), std::abs(flux.y), std::abs(flux.z)};
      sum += tree.albedo_[i] * weight;
      weights += weight;
      plain += tree.albedo_[i] * (1.0f / static_cast<float>(node.end - node.begin));
    }
    for (int c = 0; c < 3; ++c)
      sum[c] = tree.albedo_.empty() ? 0.5f : weights[c] > 0 ? sum[c] / weights[c] : plain[c];
    groups_[n] = sources(sum);
  };
  // Interleaved, as nodes near the root are the large ones.
  constexpr size_t kStripes = 16;
  parallel_ranges(kStripes, 0, [&](size_t begin, size_t end) {
    for (size_t stripe = begin; stripe < end; ++stripe)
      for (size_t n = stripe; n < nodes.size(); n += kStripes)
        make_group(n);
  });
  reach_ = std::max({mean_free_path.x, mean_free_path.y, mean_free_path.z});
}

slvm::Result<DiffusionTree> DiffusionTree::build(const PointCloud& cloud) {
  if (std::string problem = check(cloud); !problem.empty()) return slvm::Error{problem};
  if (cloud.size() > size_t{1} << 31) return slvm::Error{"more than 2^31 points"};
  if (cloud.size() > 0 && cloud.area.empty()) return slvm::Error{"the cloud has no areas"};
  if (cloud.size() > 0 && cloud.irradiance.empty())
    return slvm::Error{"the cloud has no irradiance: light it first"};
  DiffusionTree tree;
  tree.octree_ = PointOctree(cloud.position);
  auto ordered = [&](const auto& column, auto& out) {
    if (column.empty()) return;
    out.reserve(column.size());
    for (uint32_t i : tree.octree_.order())
      out.push_back(column[i]);
  };
  ordered(cloud.area, tree.area_);
  ordered(cloud.normal, tree.normal_);
  ordered(cloud.albedo, tree.albedo_);
  tree.set_irradiance(cloud.irradiance);
  return tree;
}

size_t DiffusionTree::bytes() const {
  return octree_.bytes() + groups_.size() * sizeof(Group) + area_.size() * (sizeof(float) + sizeof(Color)) +
         (normal_.size() + albedo_.size()) * sizeof(Vec3);
}

void DiffusionTree::set_irradiance(std::span<const Color> irradiance) {
  assert(irradiance.size() == area_.size());
  const auto order = octree_.order();
  flux_.resize(area_.size());
  for (size_t i = 0; i < flux_.size(); ++i)
    flux_[i] = irradiance[order[i]] * area_[i];
  sum_groups();
}

/// From the leaves up: children stand after their parents.
void DiffusionTree::sum_groups() {
  const auto nodes = octree_.nodes();
  groups_.assign(nodes.size(), {});
  struct Moments {
    double light[7] = {}, place[7] = {}; // weight, then weighted position and normal
  };
  std::vector<Moments> moments(nodes.size());
  auto add = [&](double* to, uint32_t i, double weight) {
    to[0] += weight;
    for (int c = 0; c < 3; ++c) {
      to[c + 1] += weight * static_cast<double>(octree_.positions()[i][c]);
      if (!normal_.empty()) to[c + 4] += weight * static_cast<double>(normal_[i][c]);
    }
  };
  for (size_t n = nodes.size(); n-- > 0;) {
    Group& group = groups_[n];
    const PointOctree::Node& node = nodes[n];
    for (uint32_t i = node.begin; i < node.end && node.children == 0; ++i) {
      group.area += area_[i];
      group.flux += flux_[i];
      group.dark = group.dark && weight_of(flux_[i]) == 0;
      add(moments[n].light, i, static_cast<double>(weight_of(flux_[i])));
      add(moments[n].place, i, static_cast<double>(area_[i]));
    }
    for (uint32_t c = node.first_child; c < node.first_child + node.children; ++c) {
      group.area += groups_[c].area;
      group.flux += groups_[c].flux;
      group.dark = group.dark && groups_[c].dark;
      for (int k = 0; k < 7; ++k)
        moments[n].light[k] += moments[c].light[k], moments[n].place[k] += moments[c].place[k];
    }
    const double* m = moments[n].light[0] > 0 ? moments[n].light : moments[n].place;
    group.position = node.centre;
    for (int c = 0; c < 3 && m[0] > 0; ++c) {
      group.position[c] = static_cast<float>(m[c + 1] / m[0]);
      group.normal[c] = static_cast<float>(m[c + 4] / m[0]);
    }
  }
}

/// Lookups at some places that are near each other, as those of a grid: they go through the tree together,
/// and what counts for one of them counts for most.
class DiffusionTree::Gather {
public:
  static constexpr size_t kMost = 16; ///< places

  Gather(const DiffusionTree& tree, const DiffusionMaterial& material, const LookupOptions& options)
      : tree_(tree), material_(material), options_(options),
        everywhere_(options.shell.inner <= 0 && !std::isfinite(options.shell.outer)),
        follows_(options.follow_topology > 0 && tree.has_normals() && !options.normals.empty()) {
    const Shell& s = options.shell;
    begin_ = s.inner > 0 ? s.inner * (1 - s.fade) : 0;
    full_begin_ = s.inner > 0 ? s.inner * (1 + s.fade) : 0;
    full_end_ = s.outer * (1 - s.fade);
    end_ = s.outer * (1 + s.fade);
    // Lanes that never get a source hold finite numbers, and no lane divides by 0.
    for (size_t lane = 0; lane < kBlock; ++lane)
      set_lane(lane, {}, {}, material_.samples_.empty() ? kNothing : material_.samples_[0]);
  }

  /// Places x, the first of which is `first` of the lookup's.
  void run(std::span<const Vec3> x, size_t first, std::span<Color> out, LookupCount* count) {
    x_ = x;
    if (follows_) normals_ = options_.normals.subspan(first, x.size());
    std::fill_n(sums_.begin(), x.size(), DipoleSums());
    count_ = {};
    const auto nodes = tree_.octree_.nodes();
    todo_.clear();
    if (!nodes.empty()) {
      Open root{0, {}};
      std::fill_n(root.part.begin(), x.size(), 1.0f);
      todo_.push_back(root);
    }
    while (!todo_.empty()) {
      Open open = todo_.back();
      todo_.pop_back();
      const PointOctree::Node& node = nodes[open.node];
      if (tree_.groups_[open.node].dark || !take_group(node, open)) continue;
      if (!node.children) {
        add_samples(node, open.part);
        continue;
      }
      for (uint32_t i = node.children; i-- > 0;) {
        todo_.push_back(open);
        todo_.back().node = node.first_child + i;
      }
    }
    if (filled_) flush();
    for (size_t k = 0; k < x.size(); ++k)
      out[k] = sums_[k].total();
    if (count) count->groups += count_.groups, count->samples += count_.samples;
  }

private:
  using Parts = std::array<float, kMost>; ///< a number for each place
  /// A node still to be visited, and which part of its light is still to be counted at each place.
  struct Open {
    uint32_t node;
    Parts part;
  };

  /// Lets the group stand for its members where it is seen small. Whether anything is left to be counted.
  bool take_group(const PointOctree::Node& node, Open& open) {
    const Group& group = tree_.groups_[open.node];
    Parts weight{};
    bool taken = false, left = false;
    for (size_t k = 0; k < x_.size(); ++k) {
      float& rest = open.part[k];
      if (rest > 0 && !reaches(node, x_[k])) rest = 0;
      if (rest <= 0) continue;
      const Vec3 from = x_[k] - group.position;
      const float d2 = length2(from);
      if (group.area <= options_.epsilon * d2 && !node.contains(x_[k]) && fully_inside(node, x_[k])) {
        const float part =
            options_.smooth ? rest * part_of_group(group.area / (options_.epsilon * d2)) : rest;
        weight[k] = part * passed(k, from, d2, group.normal);
        taken |= part > 0;
        count_.groups += part > 0;
        rest -= part;
      }
      left |= rest > 0;
    }
    if (taken)
      add(group.position, group.flux, weight, material_.uniform_ ? nullptr : &material_.groups_[open.node]);
    return left;
  }

  void add_samples(const PointOctree::Node& node, const Parts& part) {
    const bool plain = everywhere_ && !follows_;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Vec3 at = tree_.octree_.positions()[i];
      Parts weight = part;
      for (size_t k = 0; k < x_.size(); ++k) {
        if (part[k] <= 0) {
          weight[k] = 0;
          continue;
        }
        if (!plain) weight[k] *= weight_of_sample(k, x_[k] - at, i);
        count_.samples += weight[k] != 0;
      }
      add(at, tree_.flux_[i], weight, material_.uniform_ ? nullptr : &material_.samples_[i]);
    }
  }

  float weight_of_sample(size_t k, Vec3 from, uint32_t sample) const {
    const float d2 = length2(from), weight = everywhere_ ? 1 : options_.shell.weight(std::sqrt(d2));
    return weight == 0 || !follows_ ? weight : weight * passed(k, from, d2, tree_.normal_[sample]);
  }

  /// What does not cross air, of the light of samples whose mean normal is `normal`; `from` them to a place.
  float passed(size_t k, Vec3 from, float d2, Vec3 normal) const {
    if (!follows_) return 1;
    const float reach = std::max(std::sqrt(d2), material_.reach_);
    const float facing = (1 - dot(normals_[k], normal)) * (1 - dot(normals_[k], from) / reach) / 2;
    return 1 - options_.follow_topology * std::clamp(facing, 0.0f, 1.0f);
  }

  bool reaches(const PointOctree::Node& node, Vec3 x) const {
    if (everywhere_) return true;
    return node.near_distance2(x) <= end_ * end_ && node.far_distance2(x) >= begin_ * begin_;
  }

  bool fully_inside(const PointOctree::Node& node, Vec3 x) const {
    if (everywhere_) return true;
    return node.near_distance2(x) >= full_begin_ * full_begin_ &&
           node.far_distance2(x) < full_end_ * full_end_;
  }

  void set_lane(size_t lane, Vec3 position, Color flux, const DiffusionMaterial::Sources& sources) {
    for (int c = 0; c < 3; ++c) {
      block_.position[c][lane] = position[c];
      block_.flux[c][lane] = flux[c];
      block_.dipole[c].gain[lane] = sources.gain[c];
      block_.dipole[c].transport[lane] = sources.transport[c];
      block_.dipole[c].z_real[lane] = sources.z_real[c];
      block_.dipole[c].z_virtual[lane] = sources.z_virtual[c];
    }
  }

  /// `sources` null: those of all.
  void add(Vec3 position, Color flux, const Parts& weight, const DiffusionMaterial::Sources* sources) {
    if (sources) {
      set_lane(filled_, position, flux, *sources);
    } else {
      for (int c = 0; c < 3; ++c) {
        block_.position[c][filled_] = position[c];
        block_.flux[c][filled_] = flux[c];
      }
    }
    for (size_t k = 0; k < x_.size(); ++k)
      weight_[k][filled_] = weight[k];
    if (++filled_ == kBlock) flush();
  }

  void flush() {
    for (size_t k = 0; k < x_.size(); ++k) {
      std::fill(weight_[k] + filled_, weight_[k] + kBlock, 0.0f);
      if (std::any_of(weight_[k], weight_[k] + filled_, [](float w) { return w != 0; }))
        add_dipoles(block_, x_[k], weight_[k], sums_[k]);
    }
    filled_ = 0;
  }

  static constexpr DiffusionMaterial::Sources kNothing{{}, {}, {1, 1, 1}, {1, 1, 1}};

  const DiffusionTree& tree_;
  const DiffusionMaterial& material_;
  const LookupOptions& options_;
  bool everywhere_, follows_;
  float begin_, full_begin_, full_end_, end_;
  std::span<const Vec3> x_, normals_;
  std::vector<Open> todo_;
  size_t filled_ = 0;
  DipoleBlock block_{};
  alignas(64) float weight_[kMost][kBlock] = {};
  std::array<DipoleSums, kMost> sums_;
  LookupCount count_;
};

void DiffusionTree::exitance(const DiffusionMaterial& material, std::span<const Vec3> x,
                             const LookupOptions& options, std::span<Color> out, LookupCount* count) const {
  assert(out.size() >= x.size());
  assert(options.normals.empty() || options.normals.size() >= x.size());
  Gather gather(*this, material, options);
  // What is near compared with the samples meets the same groups. A guess that costs time at worst.
  constexpr float kNearSamples = 8;
  const float samples = static_cast<float>(std::max<size_t>(size(), 1));
  const float near2 = groups_.empty() ? 0 : kNearSamples * kNearSamples * groups_[0].area / samples;
  for (size_t i = 0, end; i < x.size(); i = end) {
    end = i + 1;
    while (end < x.size() && end - i < Gather::kMost && length2(x[end] - x[i]) <= near2)
      ++end;
    gather.run(x.subspan(i, end - i), i, out.subspan(i), count);
  }
}

Color DiffusionTree::exitance(const DiffusionMaterial& material, Vec3 x, const LookupOptions& options) const {
  Color light;
  exitance(material, std::span(&x, 1), options, std::span(&light, 1));
  return light;
}

} // namespace subsurface
