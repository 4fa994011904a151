// Constructive solid geometry: the tree that the SolidBegin blocks of one solid make (RISpec 3.2, 5.9), and
// on which side of the solid a point is when it crosses one surface after another. Read next:
// hider/solid_hits.h.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace render {

enum class SolidOperation : uint8_t {
  kPrimitive, ///< what closed surfaces enclose
  kUnion,
  kIntersection,
  kDifference, ///< the first operand without all others
};

class SolidTree {
public:
  using NodeIndex = uint32_t;
  static constexpr NodeIndex kNone = 0xffffffffu;

  struct Node {
    SolidOperation operation;
    NodeIndex parent;                ///< kNone: this is the root
    NodeIndex first_operand = kNone; ///< in order of addition
    uint32_t operands = 0;
  };

  /// A tree of one node. `number` tells the solids of a scene apart, in order; from 1.
  SolidTree(uint32_t number, SolidOperation root) : number_(number) { add(root, kNone); }

  static constexpr NodeIndex kRoot = 0;
  NodeIndex add(SolidOperation operation, NodeIndex parent);
  size_t size() const { return nodes_.size(); }
  const Node& operator[](NodeIndex n) const { return nodes_[n]; }
  uint32_t number() const { return number_; }

private:
  uint32_t number_;
  std::vector<Node> nodes_;
};

/// A place in a tree; null: there is no solid.
struct SolidPlace {
  std::shared_ptr<SolidTree> tree;
  SolidTree::NodeIndex node = SolidTree::kRoot;

  bool in_operation() const { return tree && (*tree)[node].operation != SolidOperation::kPrimitive; }
  bool in_primitive() const { return tree && !in_operation(); }
  /// Whether there is something to work out: a primitive by itself is what it would be without the block.
  bool is_operand() const {
    return tree && (*tree)[SolidTree::kRoot].operation != SolidOperation::kPrimitive;
  }
};

/// Whether a point is inside a solid, kept up to date while it crosses surfaces. It starts outside of all
/// primitives. A crossing costs at most the depth of the tree.
class SolidSide {
public:
  explicit SolidSide(const SolidTree& tree) : tree_(tree), inside_(tree.size()), count_(tree.size()) {}

  bool inside() const { return inside_[SolidTree::kRoot]; }
  /// Crosses a surface of a primitive.
  void cross(SolidTree::NodeIndex primitive);

private:
  bool value(SolidTree::NodeIndex operation) const;

  const SolidTree& tree_;
  std::vector<uint8_t> inside_;
  std::vector<uint32_t> count_; ///< operands the point is inside of
};

} // namespace render
