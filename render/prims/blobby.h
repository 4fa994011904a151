// Blobby: an implicit surface, the set of points where a field made of leaves and operators has a certain
// value. Leaves are (1 - r^2)^3 of a distance r below 1; the surface is where the field is that of r = 1/2.
#pragma once

#include "render/prims/blobby_ground.h"
#include "render/prims/primitive_list.h"
#include "render/state/declaration.h"
#include "slvm/support/result.h"

#include <functional>
#include <span>
#include <string>

namespace render {

class BlobbyField {
public:
  static constexpr double kThreshold = 0.421875; ///< (1 - 1/4)^3

  /// The ground of the string with this number; null: there is none, and nothing repels.
  using FindGround = std::function<std::shared_ptr<const BlobbyGround>(int)>;
  /// Which operators the codes 4 and 5 are: subtract and divide as in the RenderMan Interface Specification
  /// 3.2, table 5.3, and in PRMan; or the other way round, as in the table of its application note 31.
  enum class Codes : uint8_t { kSpecification, kNote31 };
  /// Told what is wrong, and what is done without it.
  using Warn = std::function<void(const std::string&)>;
  /// From the arguments of the request. Leaves that cannot be have the field 0; behind a code that is not
  /// known nothing can be read, and what stands before is added up.
  static BlobbyField make(std::span<const int> code, std::span<const float> floats, const Warn& warn,
                          const FindGround& find_ground = {}, Codes codes = Codes::kSpecification);

  double at(glm::dvec3 p) const;
  /// A field that has the same values in `box`, without the leaves that do not reach it: cheaper where there
  /// are many.
  BlobbyField near(const Box& box) const;
  /// What part of a variable's value comes from each leaf: sums and products share it in proportion to their
  /// operands' fields, a maximum or minimum takes it from the operand that decides, a difference or quotient
  /// from its first. The parts add up to 1; constants have none.
  void shares(glm::dvec3 p, std::span<double> out) const;
  /// Unit vector to where the field falls fastest.
  glm::dvec3 outwards(glm::dvec3 p, double step) const;
  size_t leaves() const { return leaf_count_; }
  /// A point as leaf `leaf` has it: in the space where it is a unit sphere or a plain segment. Constants,
  /// grounds and what cannot be have none of their own.
  glm::dvec3 in_leaf(size_t leaf, glm::dvec3 p) const;
  /// Around all leaves but constants and grounds, which are everywhere.
  Box bound() const { return bound_; }
  /// The smallest radius of a leaf.
  float smallest() const { return smallest_; }

private:
  enum class Kind : uint8_t {
    kConstant,
    kEllipsoid,
    kSegment,
    kGround,
    kAdd,
    kMultiply,
    kMax,
    kMin,
    kSubtract,
    kDivide,
    kNegate,
    kIdentity
  };
  struct Node {
    Kind kind = Kind::kConstant;
    float constant = 0;
    Matrix4 to_leaf; ///< into the space where an ellipsoid is the unit sphere
    Vec3 a{0.0f}, b{0.0f};
    float radius = 1;
    std::shared_ptr<const BlobbyGround> ground;
    GroundProfile profile;
    Box box;
    std::vector<int> operands;
  };
  std::string add_leaf(int code, std::span<const float> floats, Node& node);
  std::string add_operator(int code, std::span<const int> operands, Node& node) const;
  void add_up_roots();
  static double leaf(const Node& node, glm::dvec3 p);
  int near_operator(const Node& node, const std::vector<int>& kept);
  /// The fields of all nodes.
  void evaluate(glm::dvec3 p, double* value) const;
  static void pass_on(const Node& node, const double* value, double part, double* parts);

  std::vector<Node> nodes_;
  size_t leaf_count_ = 0;
  Box bound_;
  float smallest_ = kInfinity;
};

/// Appends the surface as smooth quadrilaterals about as large as `wanted`, in object space: between 12 and
/// 24 across the smallest leaf where that is not too many. Varying and vertex variables have a value for each
/// leaf and are mixed by the leaves' fields.
void add_blobby(const BlobbyField& field, float wanted, std::span<const TypedParam> vars,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out);

} // namespace render
