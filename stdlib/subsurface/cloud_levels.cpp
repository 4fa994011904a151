// Clouds of several densities: made from a tree, and summed together. The tree's own sums:
// diffusion_tree.cpp.
#include "stdlib/subsurface/diffusion_tree.h"

#include <cassert>

namespace subsurface {

PointCloud DiffusionTree::coarser(float size) const {
  PointCloud cloud;
  auto add = [&](uint32_t begin, uint32_t end, const Group& group) {
    Vec3 normal;
    Color albedo;
    float weight = 0;
    for (uint32_t i = begin; i < end; ++i) {
      const float w = area_[i] > 0 ? area_[i] : 1e-30f;
      if (!normal_.empty()) normal += normal_[i] * w;
      if (!albedo_.empty()) albedo += albedo_[i] * w;
      weight += w;
    }
    cloud.position.push_back(group.position);
    cloud.area.push_back(group.area);
    cloud.irradiance.push_back(group.area > 0 ? group.flux * (1 / group.area) : Color{});
    if (!normal_.empty()) cloud.normal.push_back(normalize(normal));
    if (!albedo_.empty()) cloud.albedo.push_back(albedo * (1 / weight));
  };
  PointOctree::Stack stack(octree_);
  const auto nodes = octree_.nodes();
  while (const PointOctree::Node* node = stack.pop()) {
    const auto index = static_cast<size_t>(node - nodes.data());
    if (2 * node->half <= size)
      add(node->begin, node->end, groups_[index]);
    else if (node->children)
      stack.push_children(*node);
    else
      for (uint32_t i = node->begin; i < node->end; ++i)
        add(i, i + 1, {octree_.positions()[i], area_[i], flux_[i], false, {}});
  }
  return cloud;
}

void CloudLevels::exitance(std::span<const Vec3> x, float epsilon, float fade, std::span<Color> out,
                           LookupCount* count) const {
  assert(out.size() >= x.size());
  std::vector<Color> part(x.size());
  std::fill(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(x.size()), Color{});
  float inner = 0;
  for (size_t l = 0; l < levels_.size(); ++l) {
    LookupOptions options;
    options.epsilon = epsilon;
    options.shell = {inner, std::numeric_limits<float>::infinity(), fade};
    if (l + 1 < levels_.size()) options.shell.outer = levels_[l].radius;
    levels_[l].tree->exitance(*levels_[l].material, x, options, part, count);
    for (size_t i = 0; i < x.size(); ++i)
      out[i] += part[i];
    inner = levels_[l].radius;
  }
}

} // namespace subsurface
