// Trees of solids.
#include "render/prims/solid.h"

namespace render {

SolidTree::NodeIndex SolidTree::add(SolidOperation operation, NodeIndex parent) {
  auto index = static_cast<NodeIndex>(nodes_.size());
  nodes_.push_back({operation, parent});
  if (parent != kNone) {
    Node& p = nodes_[parent];
    if (p.operands++ == 0) p.first_operand = index;
  }
  return index;
}

bool SolidSide::value(SolidTree::NodeIndex n) const {
  const SolidTree::Node& node = tree_[n];
  switch (node.operation) {
  case SolidOperation::kUnion: return count_[n] > 0;
  case SolidOperation::kIntersection: return count_[n] == node.operands;
  case SolidOperation::kDifference: return count_[n] == 1 && inside_[node.first_operand];
  case SolidOperation::kPrimitive: break;
  }
  return inside_[n];
}

void SolidSide::cross(SolidTree::NodeIndex n) {
  bool now = !inside_[n];
  for (;;) {
    inside_[n] = now;
    n = tree_[n].parent;
    if (n == SolidTree::kNone) return;
    count_[n] += now ? 1 : 0xffffffffu; // one less
    now = value(n);
    if (now == static_cast<bool>(inside_[n])) return;
  }
}

} // namespace render
