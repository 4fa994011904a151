#include "stdlib/subsurface/octree.h"

#include <array>
#include <cassert>
#include <numeric>
#include <queue>

namespace subsurface {

/// A node that may have to be split.
struct PointOctree::Open {
  uint32_t node = 0;
  int depth = 0;
};

bool PointOctree::Node::contains(Vec3 x) const {
  return std::abs(x.x - centre.x) <= half && std::abs(x.y - centre.y) <= half &&
         std::abs(x.z - centre.z) <= half;
}

float PointOctree::Node::near_distance2(Vec3 x) const {
  const Vec3 out{std::max(std::abs(x.x - centre.x) - half, 0.0f),
                 std::max(std::abs(x.y - centre.y) - half, 0.0f),
                 std::max(std::abs(x.z - centre.z) - half, 0.0f)};
  return length2(out);
}

float PointOctree::Node::far_distance2(Vec3 x) const {
  return length2(Vec3{std::abs(x.x - centre.x) + half, std::abs(x.y - centre.y) + half,
                      std::abs(x.z - centre.z) + half});
}

namespace {

PointOctree::Node root_of(std::span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (Vec3 p : points)
    for (int c = 0; c < 3; ++c)
      low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  PointOctree::Node root;
  root.centre = low * 0.5f + high * 0.5f;
  for (int c = 0; c < 3; ++c) // not of the widths, which may be beyond the range of floats
    root.half = std::max({root.half, high[c] - root.centre[c], root.centre[c] - low[c]});
  root.half *= 1.000001f;
  root.end = static_cast<uint32_t>(points.size());
  return root;
}

uint32_t octant_of(Vec3 centre, Vec3 p) {
  return (p.x >= centre.x ? 1u : 0u) | (p.y >= centre.y ? 2u : 0u) | (p.z >= centre.z ? 4u : 0u);
}

Vec3 octant_centre(const PointOctree::Node& node, uint32_t octant) {
  const float q = node.half / 2;
  return node.centre + Vec3{octant & 1 ? q : -q, octant & 2 ? q : -q, octant & 4 ? q : -q};
}

} // namespace

PointOctree::PointOctree(std::span<const Vec3> points, uint32_t leaf_size) {
  assert(points.size() <= size_t{1} << 31);
  if (points.empty()) return;
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  scratch_ = order_;
  nodes_.push_back(root_of(points));
  std::vector<Open> todo{{0, 0}};
  while (!todo.empty()) {
    const Open open = todo.back();
    todo.pop_back();
    split(open, std::max(leaf_size, 1u), points, todo);
  }
  positions_.reserve(points.size());
  for (uint32_t i : order_)
    positions_.push_back(points[i]);
  nodes_.shrink_to_fit();
  scratch_ = {};
}

/// Sorts the points of a node into its octants and makes nodes of those that have any. While all lie in one,
/// the node itself becomes that octant: no chains of nodes.
void PointOctree::split(Open open, uint32_t leaf_size, std::span<const Vec3> points,
                        std::vector<Open>& todo) {
  Node node = nodes_[open.node];
  std::array<uint32_t, 9> starts{};
  for (int depth = open.depth;; ++depth) {
    if (node.end - node.begin <= leaf_size || depth >= kMostDepth) return;
    starts = {};
    for (uint32_t i = node.begin; i < node.end; ++i)
      ++starts[octant_of(node.centre, points[order_[i]]) + 1];
    const auto full = std::find(starts.begin(), starts.end(), node.end - node.begin);
    open.depth = depth + 1;
    if (full == starts.end()) break;
    node.centre = octant_centre(node, static_cast<uint32_t>(full - starts.begin()) - 1);
    node.half /= 2;
    nodes_[open.node] = node;
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  auto at = starts;
  for (uint32_t i = node.begin; i < node.end; ++i)
    scratch_[node.begin + at[octant_of(node.centre, points[order_[i]])]++] = order_[i];
  std::copy(scratch_.begin() + node.begin, scratch_.begin() + node.end, order_.begin() + node.begin);
  node.first_child = static_cast<uint32_t>(nodes_.size());
  for (uint32_t octant = 0; octant < 8; ++octant) {
    if (starts[octant] == starts[octant + 1]) continue;
    Node child;
    child.centre = octant_centre(node, octant);
    child.half = node.half / 2;
    child.begin = node.begin + starts[octant];
    child.end = node.begin + starts[octant + 1];
    todo.push_back({static_cast<uint32_t>(nodes_.size()), open.depth});
    nodes_.push_back(child);
    ++node.children;
  }
  nodes_[open.node] = node;
}

namespace {

/// Whether children hold just what their parents do, each node is the child of one, and none is too deep.
bool is_tree(std::span<const PointOctree::Node> nodes, size_t points, int most_depth) {
  if (nodes.empty()) return points == 0;
  if (nodes[0].begin != 0 || nodes[0].end != points) return false;
  std::vector<int> depth(nodes.size(), -1);
  depth[0] = 0;
  for (size_t n = 0; n < nodes.size(); ++n) {
    const PointOctree::Node& node = nodes[n];
    if (depth[n] < 0 || depth[n] > most_depth || node.begin >= node.end || node.children > 8) return false;
    if (!node.children) continue;
    if (node.first_child <= n || node.first_child + size_t{node.children} > nodes.size()) return false;
    uint32_t at = node.begin;
    for (size_t c = node.first_child; c < node.first_child + size_t{node.children}; ++c) {
      if (depth[c] >= 0 || nodes[c].begin != at) return false;
      depth[c] = depth[n] + 1;
      at = nodes[c].end;
    }
    if (at != node.end) return false;
  }
  return true;
}

} // namespace

slvm::Result<PointOctree> PointOctree::of_parts(std::vector<Node> nodes, std::vector<uint32_t> order,
                                                std::vector<Vec3> positions) {
  if (order.size() != positions.size()) return slvm::Error{"the tree has an order of other points"};
  std::vector<bool> seen(order.size());
  for (uint32_t i : order) {
    if (i >= seen.size() || seen[i]) return slvm::Error{"the tree leaves points out"};
    seen[i] = true;
  }
  if (!is_tree(nodes, order.size(), kMostDepth)) return slvm::Error{"its nodes are no tree"};
  PointOctree tree;
  tree.nodes_ = std::move(nodes);
  tree.order_ = std::move(order);
  tree.positions_ = std::move(positions);
  return tree;
}

void PointOctree::nearest(Vec3 x, size_t count, std::vector<Near>& out) const {
  out.clear();
  if (nodes_.empty() || count == 0) return;
  auto nearer = [](const Near& a, const Near& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.place < b.place;
  };
  // Nodes by how near they begin; `out` is a heap with the farthest point on top.
  auto begins_later = [](const Near& a, const Near& b) { return a.distance2 > b.distance2; };
  std::priority_queue<Near, std::vector<Near>, decltype(begins_later)> todo(begins_later);
  todo.push({0, nodes_[0].near_distance2(x)});
  while (!todo.empty() && (out.size() < count || todo.top().distance2 <= out.front().distance2)) {
    const Node& node = nodes_[todo.top().place];
    todo.pop();
    for (uint32_t c = node.first_child; c < node.first_child + node.children; ++c)
      todo.push({c, nodes_[c].near_distance2(x)});
    for (uint32_t i = node.begin; i < node.end && !node.children; ++i) {
      out.push_back({i, length2(x - positions_[i])});
      std::push_heap(out.begin(), out.end(), nearer);
      if (out.size() <= count) continue;
      std::pop_heap(out.begin(), out.end(), nearer);
      out.pop_back();
    }
  }
  std::sort_heap(out.begin(), out.end(), nearer);
}

} // namespace subsurface
