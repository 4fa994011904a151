// An octree over points: which of them are near, and boxes round groups of them. What the points carry is for
// others: diffusion_tree.h sums light over it, scatter_map.h finds the samples round a shading point.
#pragma once

#include "slvm/support/result.h"
#include "stdlib/subsurface/vec3.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace subsurface {

/// Not changed once built: any number of threads may look.
class PointOctree {
public:
  /// A cube round the points [begin, end) of order(). Only leaves hold points directly.
  struct Node {
    Vec3 centre;
    float half = 0;
    uint32_t begin = 0, end = 0;
    uint32_t first_child = 0; ///< its children stand one after another
    uint8_t children = 0;     ///< how many are not empty; 0: a leaf

    bool contains(Vec3 x) const;
    /// From x to the nearest place of the cube, squared; 0 inside.
    float near_distance2(Vec3 x) const;
    /// From x to the farthest corner, squared.
    float far_distance2(Vec3 x) const;
  };

  PointOctree() = default;
  /// Leaves are split while they hold more than `leaf_size` points (8: Jensen and Buhler 2002, 3) that
  /// differ. At most 2^31 points, all finite. At most two nodes a point.
  explicit PointOctree(std::span<const Vec3> points, uint32_t leaf_size = 8);
  /// From what nodes(), order() and positions() of another gave (a file). The error says what cannot be.
  static slvm::Result<PointOctree> of_parts(std::vector<Node> nodes, std::vector<uint32_t> order,
                                            std::vector<Vec3> positions);

  /// Node 0 is the root; children come after their parents. Empty without points.
  std::span<const Node> nodes() const { return nodes_; }
  /// The points' indices, those of each node side by side.
  std::span<const uint32_t> order() const { return order_; }
  /// The points in that order.
  std::span<const Vec3> positions() const { return positions_; }
  /// Memory that it takes.
  size_t bytes() const {
    return nodes_.size() * sizeof(Node) + order_.size() * sizeof(uint32_t) + positions_.size() * sizeof(Vec3);
  }

  /// Calls f(place in order(), distance squared) for each point not farther from x than `radius`, always in
  /// the same order.
  template <class F> void for_each_within(Vec3 x, float radius, F&& f) const {
    Stack stack(*this);
    const float most = radius * radius;
    while (const Node* node = stack.pop()) {
      if (node->near_distance2(x) > most) continue;
      if (node->children) {
        stack.push_children(*node);
        continue;
      }
      for (uint32_t i = node->begin; i < node->end; ++i)
        if (const float d2 = length2(x - positions_[i]); d2 <= most) f(i, d2);
    }
  }

  /// A point and its distance squared.
  struct Near {
    uint32_t place = 0; ///< in order()
    float distance2 = 0;
  };
  /// The `count` points nearest to x, or all if there are fewer; nearer ones first, of equal ones the first
  /// in order().
  void nearest(Vec3 x, size_t count, std::vector<Near>& out) const;

  /// Nodes still to be visited, depth first.
  class Stack {
  public:
    explicit Stack(const PointOctree& tree) : nodes_(tree.nodes_.data()) {
      if (!tree.nodes_.empty()) todo_[size_++] = 0;
    }
    const Node* pop() { return size_ ? nodes_ + todo_[--size_] : nullptr; }
    void push_children(const Node& node) {
      for (uint32_t i = node.children; i-- > 0;)
        todo_[size_++] = node.first_child + i;
    }

  private:
    const Node* nodes_;
    uint32_t
        todo_[8 * 64]; // seven more than it takes away for each level, of which there are at most kMostDepth
    uint32_t size_ = 0;
  };

private:
  static constexpr int kMostDepth = 48;

  struct Open;
  void split(Open open, uint32_t leaf_size, std::span<const Vec3> points, std::vector<Open>& todo);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_, scratch_;
  std::vector<Vec3> positions_;
};

} // namespace subsurface
