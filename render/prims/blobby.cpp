// The field of a Blobby.
#include "render/prims/blobby.h"

#include <fmt/format.h>

#include <cmath>

namespace render {

namespace {

using Vec3d = glm::dvec3;

double falloff(double r2) {
  double s = 1 - r2;
  return s > 0 ? s * s * s : 0;
}

Vec3d transform(const Matrix4& m, Vec3d p) {
  Vec3d out;
  for (int c = 0; c < 3; ++c)
    out[c] = p.x * static_cast<double>(m(0, c)) + p.y * static_cast<double>(m(1, c)) +
             p.z * static_cast<double>(m(2, c)) + static_cast<double>(m(3, c));
  return out;
}

Matrix4 matrix_at(const float* numbers) {
  Matrix4 m;
  std::copy_n(numbers, 16, m.m.begin());
  return m;
}

float shortest_axis(const Matrix4& m) {
  float shortest = kInfinity;
  for (Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    shortest = std::min(shortest, glm::length(transform_vector(m, axis)));
  return shortest;
}

} // namespace

/// Fills in a leaf of the code 1000 to 1003 from its numbers. The text of an error, or nothing.
std::string BlobbyField::add_leaf(int code, std::span<const float> floats, Node& node) {
  constexpr size_t kNumbers[] = {1, 16, 23, 4};
  size_t want = kNumbers[code - 1000];
  if (floats.size() < want)
    return fmt::format("a leaf of code {} takes {} numbers; there are {} from its index on", code, want,
                       floats.size());
  for (float f : floats.first(want))
    if (!std::isfinite(f)) return fmt::format("a leaf of code {} has a number that is not finite", code);
  if (code == 1000) {
    node.constant = floats[0];
    return {};
  }
  if (code == 1003) {
    node.kind = Kind::kPlane;
    has_planes_ = true;
    return {};
  }
  bool segment = code == 1002;
  node.kind = segment ? Kind::kSegment : Kind::kEllipsoid;
  Matrix4 m = matrix_at(floats.data() + (segment ? 7 : 0));
  if (!slvm::invert(m, node.to_leaf))
    return fmt::format("the matrix of a leaf of code {} has no inverse", code);
  Box local;
  local.add(Vec3(0.0f));
  if (segment) {
    node.a = {floats[0], floats[1], floats[2]};
    node.b = {floats[3], floats[4], floats[5]};
    node.radius = floats[6];
    if (!(node.radius > 0))
      return fmt::format("the radius of a segment is {}; it must be positive", node.radius);
    local = {};
    local.add(node.a);
    local.add(node.b);
  }
  local.grow(node.radius);
  node.box = transform_box(m, local);
  bound_.add(node.box);
  smallest_ = std::min(smallest_, node.radius * shortest_axis(m));
  return {};
}

slvm::Result<BlobbyField> BlobbyField::make(int leaves, std::span<const int> code,
                                            std::span<const float> floats) {
  BlobbyField out;
  size_t i = 0;
  auto take = [&](size_t n) {
    std::span<const int> part =
        code.subspan(std::min(i, code.size()), std::min(n, code.size() - std::min(i, code.size())));
    i += n;
    return part;
  };
  while (i < code.size()) {
    int op = code[i++];
    Node node;
    if (op >= 1000 && op <= 1003) {
      auto operands = take(op == 1003 ? 2 : 1);
      int index = operands.empty() ? -1 : operands.back();
      if (i > code.size() || index < 0 || static_cast<size_t>(index) > floats.size())
        return slvm::Error{fmt::format("a leaf of code {} has no index of its numbers", op)};
      std::string wrong = out.add_leaf(op, floats.subspan(static_cast<size_t>(index)), node);
      if (!wrong.empty()) return slvm::Error{wrong};
      ++out.leaf_count_;
    } else if (op >= 0 && op <= 7) {
      node.kind = static_cast<Kind>(static_cast<int>(Kind::kAdd) + op);
      size_t count = op >= 6 ? 1 : 2;
      if (op <= 3) {
        auto n = take(1);
        count = n.empty() || n[0] < 1 ? 0 : static_cast<size_t>(n[0]);
      }
      auto operands = take(count);
      if (count == 0 || operands.size() != count)
        return slvm::Error{fmt::format("operator {} ends before its operands", op)};
      for (int o : operands)
        if (o < 0 || static_cast<size_t>(o) >= out.nodes_.size())
          return slvm::Error{fmt::format("operator {} uses result {}, which does not precede it", op, o)};
      node.operands.assign(operands.begin(), operands.end());
    } else {
      return slvm::Error{fmt::format("unknown code {}", op)};
    }
    out.nodes_.push_back(std::move(node));
  }
  if (static_cast<size_t>(std::max(leaves, 0)) != out.leaf_count_)
    return slvm::Error{fmt::format("'nleaf' is {}, but the code has {} leaves", leaves, out.leaf_count_)};
  return out;
}

double BlobbyField::leaf(const Node& node, Vec3d p) {
  if (node.kind == Kind::kConstant) return node.constant;
  if (node.kind == Kind::kPlane) return 0;
  for (int c = 0; c < 3; ++c)
    if (p[c] < static_cast<double>(node.box.min[c]) || p[c] > static_cast<double>(node.box.max[c])) return 0;
  Vec3d q = transform(node.to_leaf, p);
  if (node.kind == Kind::kEllipsoid) return falloff(glm::dot(q, q));
  Vec3d a(node.a), along = Vec3d(node.b) - a;
  double length2 = glm::dot(along, along);
  double t = length2 > 0 ? std::clamp(glm::dot(q - a, along) / length2, 0.0, 1.0) : 0;
  Vec3d d = q - (a + along * t);
  double radius = node.radius;
  return falloff(glm::dot(d, d) / (radius * radius));
}

double BlobbyField::at(Vec3d p, std::span<double> leaf_values) const {
  constexpr size_t kOnStack = 64;
  double few[kOnStack];
  std::vector<double> many(nodes_.size() > kOnStack ? nodes_.size() : 0);
  double* value = many.empty() ? few : many.data();
  size_t leaf_index = 0;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    if (n.operands.empty()) {
      value[i] = leaf(n, p);
      if (!leaf_values.empty()) leaf_values[leaf_index++] = n.kind == Kind::kConstant ? 0 : value[i];
      continue;
    }
    double v = value[n.operands[0]];
    for (size_t k = 1; k < n.operands.size(); ++k) {
      double w = value[n.operands[k]];
      switch (n.kind) {
      case Kind::kAdd: v += w; break;
      case Kind::kMultiply: v *= w; break;
      case Kind::kMax: v = std::max(v, w); break;
      case Kind::kMin: v = std::min(v, w); break;
      case Kind::kDivide: v = w != 0 ? v / w : 0; break;
      default: v -= w;
      }
    }
    value[i] = n.kind == Kind::kNegate ? -v : v;
  }
  return nodes_.empty() ? 0 : value[nodes_.size() - 1];
}

Vec3d BlobbyField::outwards(Vec3d p, double step) const {
  Vec3d slope;
  for (int c = 0; c < 3; ++c) {
    Vec3d d(0.0);
    d[c] = step;
    slope[c] = at(p - d) - at(p + d);
  }
  double length = glm::length(slope);
  return length > 0 ? slope / length : Vec3d(0, 0, 1);
}

} // namespace render
