#include "stdlib/subsurface/diffusion_tree.h"

#include "stdlib/subsurface/dipole_block.h"

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
  samples_.reserve(tree.size());
  for (size_t i = 0; i < tree.size(); ++i)
    samples_.push_back(sources(tree.albedo_.empty() ? Color{0.5f, 0.5f, 0.5f} : tree.albedo_[i]));
  const auto nodes = tree.octree_.nodes();
  groups_.reserve(nodes.size());
  for (const PointOctree::Node& node : nodes) {
    Color sum, weights, plain;
    for (uint32_t i = node.begin; i < node.end && !tree.albedo_.empty(); ++i) {
      const Color flux = tree.flux_[i], weight{std::abs(flux.x), std::abs(flux.y), std::abs(flux.z)};
      sum += tree.albedo_[i] * weight;
      weights += weight;
      plain += tree.albedo_[i] * (1.0f / static_cast<float>(node.end - node.begin));
    }
    for (int c = 0; c < 3; ++c)
      sum[c] = tree.albedo_.empty() ? 0.5f : weights[c] > 0 ? sum[c] / weights[c] : plain[c];
    groups_.push_back(sources(sum));
  }
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

/// One lookup: collects sources in blocks and sums them.
class DiffusionTree::Gather {
public:
  Gather(const DiffusionTree& tree, const DiffusionMaterial& material, const LookupOptions& options)
      : tree_(tree), material_(material), options_(options),
        everywhere_(options.shell.inner <= 0 && !std::isfinite(options.shell.outer)),
        follows_(options.follow_topology > 0 && tree.has_normals() && !options.normals.empty()) {
    const Shell& s = options.shell;
    begin_ = s.inner > 0 ? s.inner * (1 - s.fade) : 0;
    full_begin_ = s.inner > 0 ? s.inner * (1 + s.fade) : 0;
    full_end_ = s.outer * (1 - s.fade);
    end_ = s.outer * (1 + s.fade);
    std::fill(std::begin(distance2_), std::end(distance2_), 1.0f); // no lane divides by 0
  }

  /// Place `at` of the lookup's.
  Color run(Vec3 x, size_t at, LookupCount* count) {
    if (follows_) normal_ = options_.normals[at];
    for (auto& lanes : sum_)
      std::fill(std::begin(lanes), std::end(lanes), 0.0f);
    count_ = {};
    const auto nodes = tree_.octree_.nodes();
    todo_.clear();
    if (!nodes.empty()) todo_.push_back({0, 1});
    while (!todo_.empty()) {
      const Open open = todo_.back();
      todo_.pop_back();
      const PointOctree::Node& node = nodes[open.node];
      const Group& group = tree_.groups_[open.node];
      if (group.dark || !reaches(node, x)) continue;
      float rest = open.part;
      const Vec3 from = x - group.position;
      const float d2 = length2(from);
      if (group.area <= options_.epsilon * d2 && !node.contains(x) && fully_inside(node, x)) {
        const float part =
            options_.smooth ? open.part * part_of_group(group.area / (options_.epsilon * d2)) : open.part;
        if (part > 0) {
          add(d2, group.flux * (part * passed(from, d2, group.normal)),
              material_.uniform_ ? nullptr : &material_.groups_[open.node]);
          ++count_.groups;
        }
        rest -= part;
        if (rest <= 0) continue;
      }
      if (node.children)
        for (uint32_t i = node.children; i-- > 0;)
          todo_.push_back({node.first_child + i, rest});
      else
        add_samples(node, x, rest);
    }
    if (count) count->groups += count_.groups, count->samples += count_.samples;
    return finish();
  }

private:
  /// A node still to be visited, and which part of its light is still to be counted.
  struct Open {
    uint32_t node;
    float part;
  };

  /// What does not cross air, of the light of samples whose mean normal is `normal`; `from` them to x.
  float passed(Vec3 from, float d2, Vec3 normal) const {
    if (!follows_) return 1;
    const float reach = std::max(std::sqrt(d2), material_.reach_);
    const float facing = (1 - dot(normal_, normal)) * (1 - dot(normal_, from) / reach) / 2;
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

  void add_samples(const PointOctree::Node& node, Vec3 x, float part) {
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Vec3 from = x - tree_.octree_.positions()[i];
      const float d2 = length2(from);
      float weight = everywhere_ ? part : part * options_.shell.weight(std::sqrt(d2));
      if (weight == 0) continue;
      if (follows_) weight *= passed(from, d2, tree_.normal_[i]);
      add(d2, tree_.flux_[i] * weight, material_.uniform_ ? nullptr : &material_.samples_[i]);
      ++count_.samples;
    }
  }

  void add(float distance2, Color flux, const DiffusionMaterial::Sources* sources) {
    distance2_[filled_] = distance2;
    for (int c = 0; c < 3; ++c) {
      flux_[c][filled_] = flux[c];
      if (!sources) continue;
      lanes_[c].gain[filled_] = sources->gain[c];
      lanes_[c].transport[filled_] = sources->transport[c];
      lanes_[c].z_real[filled_] = sources->z_real[c];
      lanes_[c].z_virtual[filled_] = sources->z_virtual[c];
    }
    if (++filled_ == kBlock) flush();
  }

  void flush() {
    for (size_t c = 0; c < 3; ++c) {
      if (!material_.uniform_) {
        add_dipoles(distance2_, flux_[c], lanes_[c], sum_[c]);
        continue;
      }
      const DiffusionMaterial::Sources& s = material_.samples_[0];
      add_dipoles(distance2_, flux_[c], s.gain[c], s.transport[c], s.z_real[c], s.z_virtual[c], sum_[c]);
    }
    filled_ = 0;
  }

  Color finish() {
    // Lanes that are left have no light; what else stands in them is from an earlier block, and finite.
    for (size_t i = filled_; i < kBlock; ++i)
      flux_[0][i] = flux_[1][i] = flux_[2][i] = 0;
    if (filled_) flush();
    Color total;
    for (int c = 0; c < 3; ++c)
      for (float lane : sum_[c])
        total[c] += lane;
    return total;
  }

  const DiffusionTree& tree_;
  const DiffusionMaterial& material_;
  const LookupOptions& options_;
  bool everywhere_, follows_;
  Vec3 normal_; // at x
  std::vector<Open> todo_;
  float begin_, full_begin_, full_end_, end_;
  size_t filled_ = 0;
  float distance2_[kBlock], flux_[3][kBlock] = {}, sum_[3][kBlock] = {};
  DipoleLanes lanes_[3] = {};
  LookupCount count_;
};

void DiffusionTree::exitance(const DiffusionMaterial& material, std::span<const Vec3> x,
                             const LookupOptions& options, std::span<Color> out, LookupCount* count) const {
  assert(out.size() >= x.size());
  assert(options.normals.empty() || options.normals.size() >= x.size());
  Gather gather(*this, material, options);
  for (size_t i = 0; i < x.size(); ++i)
    out[i] = gather.run(x[i], i, count);
}

Color DiffusionTree::exitance(const DiffusionMaterial& material, Vec3 x, const LookupOptions& options) const {
  return Gather(*this, material, options).run(x, 0, nullptr);
}

} // namespace subsurface
