// The field of a Blobby.
#include "render/prims/blobby.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

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
    node.kind = Kind::kGround;
    node.profile = {floats[0], floats[1], floats[2], floats[3]};
    if (!(node.profile.reach > 0) || !(node.profile.peak > 0))
      return fmt::format("the heights of a ground are {} and {}; they must be positive", node.profile.reach,
                         node.profile.peak);
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

namespace {
/// Leaves that are plug-ins: of PRMan, and of AIR, which says how many operands follow.
constexpr int kPlugIn = 1004, kAirPlugIn = 9000;
} // namespace

/// Fills in an operator of the code 0 to 7. The text of an error, or nothing.
std::string BlobbyField::add_operator(int code, std::span<const int> operands, Node& node) const {
  for (int o : operands)
    if (o < 0 || static_cast<size_t>(o) >= nodes_.size())
      return fmt::format("operator {} uses result {}, which does not precede it", code, o);
  node.kind = static_cast<Kind>(static_cast<int>(Kind::kAdd) + code);
  node.operands.assign(operands.begin(), operands.end());
  return {};
}

/// What no operator uses.
void BlobbyField::add_up_roots() {
  std::vector<bool> used(nodes_.size());
  for (const Node& n : nodes_)
    for (int o : n.operands)
      used[static_cast<size_t>(o)] = true;
  Node sum;
  sum.kind = Kind::kAdd;
  for (size_t i = 0; i < used.size(); ++i)
    if (!used[i]) sum.operands.push_back(static_cast<int>(i));
  if (sum.operands.size() > 1) nodes_.push_back(std::move(sum));
}

BlobbyField BlobbyField::make(std::span<const int> code, std::span<const float> floats, const Warn& warn,
                              const FindGround& find_ground, Codes codes) {
  BlobbyField out;
  size_t i = 0;
  // The next n numbers of the code; fewer where it ends.
  auto take = [&](size_t n) {
    const size_t from = std::min(i, code.size());
    i += n;
    return code.subspan(from, std::min(n, code.size() - from));
  };
  auto stop = [&](const std::string& why) {
    warn(fmt::format("{}; what follows is not read, what stands before is added up", why));
    out.add_up_roots();
    return std::move(out);
  };
  while (i < code.size()) {
    const int op = code[i++];
    Node node;
    std::string wrong;
    const bool plug_in = op == kPlugIn || op == kAirPlugIn;
    if (plug_in || (op >= 1000 && op <= 1003)) {
      size_t count = op == 1003 ? 2 : 1;
      if (op == kPlugIn) count = 5; // name, numbers, their index, strings, their index
      if (op == kAirPlugIn) {
        const auto n = take(1);
        count = n.empty() || n[0] < 1 ? 0 : static_cast<size_t>(n[0]);
      }
      const auto operands = take(count);
      if (count == 0 || operands.size() != count)
        return stop(fmt::format("a leaf of code {} ends early", op));
      const int index = operands.back();
      if (plug_in)
        wrong = fmt::format("a leaf of code {} is a plug-in, and these are not supported", op);
      else if (index < 0 || static_cast<size_t>(index) > floats.size())
        wrong = fmt::format("a leaf of code {} has its numbers from {} on, and there are {}", op, index,
                            floats.size());
      else
        wrong = out.add_leaf(op, floats.subspan(static_cast<size_t>(index)), node);
      if (wrong.empty() && op == 1003 && find_ground) node.ground = find_ground(operands[0]);
      ++out.leaf_count_;
    } else if (op >= 0 && op <= 7) {
      size_t count = op >= 6 ? 1 : 2;
      if (op <= 3) {
        const auto n = take(1);
        count = n.empty() || n[0] < 1 ? 0 : static_cast<size_t>(n[0]);
      }
      const auto operands = take(count);
      if (count == 0 || operands.size() != count)
        return stop(fmt::format("operator {} ends before its operands", op));
      const bool turned = codes == Codes::kNote31 && (op == 4 || op == 5);
      wrong = out.add_operator(turned ? 9 - op : op, operands, node);
    } else {
      return stop(fmt::format("unknown code {}", op));
    }
    if (!wrong.empty()) {
      warn(fmt::format("{}; its field is 0", wrong));
      node = {};
    }
    out.nodes_.push_back(std::move(node));
  }
  return out;
}

double BlobbyField::leaf(const Node& node, Vec3d p) {
  if (node.kind == Kind::kConstant) return node.constant;
  if (node.kind == Kind::kGround) return node.ground ? node.profile.at(node.ground->height(p)) : 0;
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

namespace {

/// Room for the values of all nodes, without the heap for most Blobbies.
class NodeValues {
public:
  explicit NodeValues(size_t n) : many_(n > kOnStack ? n : 0) { std::fill_n(data(), n, 0.0); }
  double* data() { return many_.empty() ? few_ : many_.data(); }

private:
  static constexpr size_t kOnStack = 64;
  double few_[kOnStack];
  std::vector<double> many_;
};

} // namespace

void BlobbyField::evaluate(Vec3d p, double* value) const {
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const Node& n = nodes_[i];
    if (n.operands.empty()) {
      value[i] = leaf(n, p);
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
}

double BlobbyField::at(Vec3d p) const {
  if (nodes_.empty()) return 0;
  NodeValues values(nodes_.size());
  evaluate(p, values.data());
  return values.data()[nodes_.size() - 1];
}

namespace {

constexpr int kZero = -1; ///< in place of a node whose field is 0 all over a box

bool apart(const Box& a, const Box& b) {
  for (int c = 0; c < 3; ++c)
    if (a.max[c] < b.min[c] || a.min[c] > b.max[c]) return true;
  return false;
}

} // namespace

BlobbyField BlobbyField::near(const Box& box) const {
  BlobbyField out;
  std::vector<int> kept;
  for (const Node& n : nodes_) {
    bool reaches = n.kind == Kind::kConstant || n.kind == Kind::kGround || !apart(n.box, box);
    if (!n.operands.empty()) {
      kept.push_back(out.near_operator(n, kept));
    } else if (reaches) {
      kept.push_back(static_cast<int>(out.nodes_.size()));
      out.nodes_.push_back(n);
    } else {
      kept.push_back(kZero);
    }
  }
  // The last node is the field.
  if (!kept.empty() && kept.back() != static_cast<int>(out.nodes_.size()) - 1) {
    Node last;
    if (kept.back() != kZero) {
      last.kind = Kind::kIdentity;
      last.operands = {kept.back()};
    }
    out.nodes_.push_back(std::move(last));
  }
  return out;
}

/// An operator over the nodes that are left: which node is its value now, or kZero. `kept`: of the nodes
/// before.
int BlobbyField::near_operator(const Node& node, const std::vector<int>& kept) {
  std::vector<int> operands;
  for (int o : node.operands)
    operands.push_back(kept[static_cast<size_t>(o)]);
  const bool some_zero = std::find(operands.begin(), operands.end(), kZero) != operands.end();
  switch (node.kind) {
  case Kind::kAdd: std::erase(operands, kZero); break;
  case Kind::kSubtract:
    if (operands[1] == kZero) operands.pop_back();
    break;
  case Kind::kMax:
  case Kind::kMin: break;
  default: // a product or quotient with 0, or what becomes of 0 alone
    if (some_zero) return kZero;
  }
  if (std::all_of(operands.begin(), operands.end(), [](int o) { return o == kZero; })) return kZero;
  if (operands.size() == 1 && node.kind != Kind::kNegate) return operands[0];
  for (int& o : operands)
    if (o == kZero) {
      o = static_cast<int>(nodes_.size());
      nodes_.push_back({}); // a constant 0
    }
  Node out;
  out.kind = node.kind;
  out.operands = std::move(operands);
  nodes_.push_back(std::move(out));
  return static_cast<int>(nodes_.size()) - 1;
}

/// Divides the part of a node among its operands.
void BlobbyField::pass_on(const Node& n, const double* value, double part, double* parts) {
  auto decides = [&](auto&& better) {
    int best = n.operands[0];
    for (int o : n.operands)
      if (better(value[o], value[best])) best = o;
    parts[best] += part;
  };
  switch (n.kind) {
  case Kind::kAdd:
  case Kind::kMultiply: {
    double sum = 0;
    for (int o : n.operands)
      sum += std::max(value[o], 0.0);
    for (int o : n.operands)
      if (sum > 0) parts[o] += part * std::max(value[o], 0.0) / sum;
    return;
  }
  case Kind::kMax: decides(std::greater<>()); return;
  case Kind::kMin: decides(std::less<>()); return;
  default: parts[n.operands[0]] += part;
  }
}

void BlobbyField::shares(Vec3d p, std::span<double> out) const {
  NodeValues values(nodes_.size()), parts(nodes_.size());
  evaluate(p, values.data());
  if (!nodes_.empty()) parts.data()[nodes_.size() - 1] = 1;
  size_t leaf_index = leaf_count_;
  double sum = 0;
  for (size_t i = nodes_.size(); i-- > 0;) {
    double part = parts.data()[i];
    if (!nodes_[i].operands.empty()) {
      pass_on(nodes_[i], values.data(), part, parts.data());
      continue;
    }
    out[--leaf_index] = nodes_[i].kind == Kind::kConstant ? 0 : part;
    sum += out[leaf_index];
  }
  for (double& s : out)
    s = sum > 0 ? s / sum : 1 / static_cast<double>(out.size());
}

Vec3d BlobbyField::in_leaf(size_t leaf, Vec3d p) const {
  for (const Node& n : nodes_)
    if (n.operands.empty() && leaf-- == 0) return transform(n.to_leaf, p);
  return p;
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
