// Ribbons and discs.
#include "render/prims/curves.h"

#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

#include <cmath>

namespace render {

namespace {

using Vec3d = glm::dvec3;

/// Some vector across `along`, the way `facing` is looked at from; of unit length.
Vec3d across(Vec3d along, Vec3d facing) {
  Vec3d side = glm::cross(along, facing);
  double length = glm::length(side);
  if (length > 1e-9 * glm::length(along) * glm::length(facing)) return side / length;
  // Seen end on (or a point): any direction across will do.
  Vec3d axis = std::abs(facing.x) < std::abs(facing.y) ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  side = glm::cross(glm::length(along) > 0 ? along : axis, glm::length(along) > 0 ? axis : facing);
  length = glm::length(side);
  return length > 0 ? side / length : Vec3d(1, 0, 0);
}

/// What turns a ribbon.
struct RibbonFacing {
  EyeInObject eye;
  bool by_normals = false;
  Vec3 normals[2]; ///< at both ends
};

class Ribbon final : public Geometry {
public:
  Ribbon(const std::array<Vec3, 4>& bezier, Vec2 widths, const RibbonFacing& facing)
      : p_(bezier), widths_(widths), facing_(facing) {}

  Box bound(const UvRect& r) const override {
    Box box;
    for (int j = 0; j < 4; ++j) // the blossom: control points of the part
      box.add(blossom(j > 0 ? r.v1 : r.v0, j > 1 ? r.v1 : r.v0, j > 2 ? r.v1 : r.v0));
    box.grow(0.5f * std::max(std::abs(widths_.x), std::abs(widths_.y)));
    return box;
  }

  void evaluate(std::span<const float> u, std::span<const float> v, SurfaceLattice& out) const override {
    out.resize(u.size() * v.size());
    constexpr double kStep = 1e-4;
    size_t k = 0;
    for (float vj : v) {
      Section here = section(vj), before = section(vj - kStep), after = section(vj + kStep);
      for (float ui : u) {
        double x = ui - 0.5;
        Vec3d along = (after.at(x) - before.at(x)) / (2 * kStep);
        out.P[k] = Vec3(here.at(x));
        out.dPdu[k] = Vec3(here.side);
        out.dPdv[k] = Vec3(along);
        Vec3d n = glm::cross(here.side, here.tangent);
        out.N[k] = Vec3(glm::length(n) > 0 ? glm::normalize(n) : here.facing);
        ++k;
      }
    }
  }
  std::array<int, 2> coarsest() const override { return {1, 4}; }

private:
  struct Section {
    Vec3d centre, side, tangent, facing;
    Vec3d at(double x) const { return centre + side * x; }
  };
  Vec3 blossom(float a, float b, float c) const {
    Vec3 q0 = glm::mix(p_[0], p_[1], a), q1 = glm::mix(p_[1], p_[2], a), q2 = glm::mix(p_[2], p_[3], a);
    return glm::mix(glm::mix(q0, q1, b), glm::mix(q1, q2, b), c);
  }
  /// A cross-section; `side` is as long as the ribbon is wide.
  Section section(double v) const {
    double s = 1 - v;
    Vec3d p[4] = {Vec3d(p_[0]), Vec3d(p_[1]), Vec3d(p_[2]), Vec3d(p_[3])};
    Section out;
    out.centre = p[0] * (s * s * s) + p[1] * (3 * s * s * v) + p[2] * (3 * s * v * v) + p[3] * (v * v * v);
    out.tangent = ((p[1] - p[0]) * (s * s) + (p[2] - p[1]) * (2 * s * v) + (p[3] - p[2]) * (v * v)) * 3.0;
    // Doubled end points: the direction a little inside, or of the chord.
    double size = glm::length(p[3] - p[0]) + glm::length(p[2] - p[1]);
    if (glm::length(out.tangent) < 1e-7 * size) {
      double w = v + (0.5 - v) * 1e-3, r = 1 - w;
      out.tangent = ((p[1] - p[0]) * (r * r) + (p[2] - p[1]) * (2 * r * w) + (p[3] - p[2]) * (w * w)) * 3.0;
    }
    out.facing = Vec3d(facing_.by_normals ? facing_.normals[0] * static_cast<float>(s) +
                                                facing_.normals[1] * static_cast<float>(v)
                                          : facing_.eye.from(Vec3(out.centre)));
    out.side = across(out.tangent, out.facing) * (widths_.x * s + widths_.y * v);
    return out;
  }

  std::array<Vec3, 4> p_;
  Vec2 widths_;
  RibbonFacing facing_;
};

/// A disc by the map (a sqrt(1 - b^2/2), b sqrt(1 - a^2/2)) of the square, which has no pole.
class Disc final : public Geometry {
public:
  Disc(Vec3 centre, Vec3 x, Vec3 y) : centre_(centre), x_(x), y_(y) {}

  Box bound(const UvRect&) const override {
    Box box;
    Vec3 reach = glm::abs(x_) + glm::abs(y_);
    box.add(centre_ - reach);
    box.add(centre_ + reach);
    return box;
  }
  void evaluate(std::span<const float> u, std::span<const float> v, SurfaceLattice& out) const override {
    out.fill(u, v, [&](size_t k, float ui, float vj) {
      float a = 2 * ui - 1, b = 2 * vj - 1;
      float ra = std::sqrt(1 - a * a / 2), rb = std::sqrt(1 - b * b / 2);
      out.P[k] = centre_ + x_ * (a * rb) + y_ * (b * ra);
      out.dPdu[k] = 2.0f * (x_ * rb - y_ * (b * a / (2 * ra)));
      out.dPdv[k] = 2.0f * (y_ * ra - x_ * (a * b / (2 * rb)));
      out.N[k] = glm::cross(x_, y_);
    });
  }
  std::array<int, 2> coarsest() const override { return {2, 2}; }

private:
  Vec3 centre_, x_, y_;
};

/// The variable that gives widths, the curves' normals: used by the geometry.
const TypedParam* find(std::span<const TypedParam> vars, std::string_view name, slvm::Type type) {
  for (const TypedParam& v : vars)
    if (v.declaration.name == name && v.declaration.type == type && !v.declaration.elements) return &v;
  return nullptr;
}

/// Where one segment's values stand.
struct Segment {
  size_t curve = 0;
  size_t points[4] = {};  ///< vertex values; two of a linear curve
  size_t corners[2] = {}; ///< varying values at its ends
};

size_t index_of(StorageClass c, const Segment& s, bool cubic, int end) {
  switch (c) {
  case StorageClass::kConstant: return 0;
  case StorageClass::kUniform: return s.curve;
  case StorageClass::kVertex: return s.points[end == 0 ? 0 : cubic ? 3 : 1];
  default: return s.corners[end];
  }
}

class CurveMaker {
public:
  CurveMaker(const CurveLayout& layout, std::span<const Vec3> P, std::span<const TypedParam> vars,
             const EyeInObject& eye)
      : layout_(layout), P_(P), vars_(vars), eye_(eye), width_(find(vars, "width", slvm::Type::kFloat)),
        normals_(find(vars, "N", slvm::Type::kNormal)) {
    if (!width_) width_ = find(vars, "constantwidth", slvm::Type::kFloat);
  }

  /// `before` and `after`: neighbours of a linear segment, or its own ends.
  std::shared_ptr<const Geometry> geometry(const Segment& s, size_t before, size_t after) const {
    Vec2 widths(width(s, 0), width(s, 1));
    if (layout_.cubic) {
      std::array<Vec3, 4> bezier;
      for (size_t i = 0; i < 4; ++i)
        bezier[i] = P_[s.points[i]];
      for (int c = 0; c < 3; ++c)
        curve_to_bezier(&bezier[0][c], 3);
      return std::make_shared<Ribbon>(bezier, widths, facing(s));
    }
    RibbonFacing f = facing(s);
    Vec3 a = P_[s.points[0]], b = P_[s.points[1]];
    Vec3 start = joint(P_[before], a, b, f, 0) * widths.x, end = joint(a, b, P_[after], f, 1) * widths.y;
    return make_bilinear({a - start, a + start, b - end, b + end});
  }

  PatchVar variable(const TypedParam& var, const Segment& s) const {
    const Declaration& d = var.declaration;
    if (!interpolates(d.storage)) return constant_var(var, index_of(d.storage, s, layout_.cubic, 0));
    if (!layout_.cubic || d.storage != StorageClass::kVertex) {
      size_t a = index_of(d.storage, s, layout_.cubic, 0), b = index_of(d.storage, s, layout_.cubic, 1);
      return bilinear_var(var, {a, a, b, b});
    }
    std::array<size_t, 16> indices;
    for (size_t k = 0; k < 16; ++k)
      indices[k] = s.points[k / 4];
    return bicubic_var(var, indices, bezier_basis(), layout_.basis);
  }

private:
  float width(const Segment& s, int end) const {
    if (!width_) return 1;
    return width_->numbers[index_of(width_->declaration.storage, s, layout_.cubic, end)];
  }
  RibbonFacing facing(const Segment& s) const {
    RibbonFacing out{eye_, normals_ != nullptr, {}};
    for (int end = 0; normals_ && end < 2; ++end) {
      const float* n = &normals_->numbers[3 * index_of(normals_->declaration.storage, s, layout_.cubic, end)];
      out.normals[end] = {n[0], n[1], n[2]};
    }
    return out;
  }
  void curve_to_bezier(float* values, size_t stride) const {
    Matrix4 m = inverse_or_identity(bezier_basis().matrix) * layout_.basis.matrix;
    float in[4], out[4] = {};
    for (size_t i = 0; i < 4; ++i)
      in[i] = values[i * stride];
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        out[i] += m(i, j) * in[j];
    for (size_t i = 0; i < 4; ++i)
      values[i * stride] = out[i];
  }
  /// Half the section where two straight segments meet, mitred up to twice the width.
  static Vec3 joint(Vec3 before, Vec3 at, Vec3 after, const RibbonFacing& f, int end) {
    auto unit = [](Vec3d d) { return glm::length(d) > 0 ? glm::normalize(d) : d; };
    Vec3d in = unit(Vec3d(at - before)), out = unit(Vec3d(after - at)), along = in + out;
    if (glm::length(along) < 1e-6) along = end == 0 ? out : in;
    double cosine = glm::length(in) > 0 && glm::length(out) > 0 ? glm::length(in + out) / 2 : 1;
    Vec3d facing(f.by_normals ? f.normals[end] : f.eye.from(at));
    return Vec3(across(along, facing) * (0.5 / std::max(cosine, 0.5)));
  }

  const CurveLayout& layout_;
  std::span<const Vec3> P_;
  std::span<const TypedParam> vars_;
  const EyeInObject& eye_;
  const TypedParam *width_, *normals_;
};

} // namespace

void add_curves(const CurveLayout& layout, std::span<const int> points_of_curve, std::span<const Vec3> P,
                std::span<const TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out) {
  CurveMaker maker(layout, P, vars, eye);
  size_t first = 0, first_corner = 0;
  for (size_t c = 0; c < points_of_curve.size(); ++c) {
    int points = points_of_curve[c], segments = layout.segments(points), corners = layout.varying(points);
    auto point = [&](int i) {
      i = layout.periodic ? (i + points) % points : std::clamp(i, 0, points - 1);
      return first + static_cast<size_t>(i);
    };
    for (int k = 0; k < segments; ++k) {
      Segment s;
      s.curve = c;
      for (int i = 0; i < layout.fewest(); ++i)
        s.points[i] = point(k * layout.step() + i);
      for (int i = 0; i < 2; ++i)
        s.corners[i] = first_corner + static_cast<size_t>((k + i) % corners);
      Primitive& primitive = out.emplace_back();
      primitive.state = state;
      primitive.geometry = maker.geometry(s, point(k - 1), point(k + 2));
      primitive.one_across = state->attributes->dicing.hair;
      primitive.uv = {0, 1, static_cast<float>(k) / static_cast<float>(segments),
                      static_cast<float>(k + 1) / static_cast<float>(segments)};
      for (const TypedParam& v : vars)
        primitive.vars.push_back(maker.variable(v, s));
    }
    first += static_cast<size_t>(points);
    first_corner += static_cast<size_t>(corners);
  }
}

void add_points(std::span<const Vec3> P, std::span<const TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out) {
  const TypedParam* width = find(vars, "width", slvm::Type::kFloat);
  if (!width) width = find(vars, "constantwidth", slvm::Type::kFloat);
  for (size_t i = 0; i < P.size(); ++i) {
    auto index = [&](const TypedParam& v) { return interpolates(v.declaration.storage) ? i : 0; };
    float radius = 0.5f * (width ? width->numbers[index(*width)] : 1);
    Vec3d facing(eye.from(P[i]));
    Vec3d x = across(Vec3d(0, 1, 0), facing), y = across(facing, x);
    Primitive& primitive = out.emplace_back();
    primitive.state = state;
    primitive.geometry = std::make_shared<Disc>(P[i], Vec3(x) * radius, Vec3(y) * radius);
    for (const TypedParam& v : vars)
      primitive.vars.push_back(constant_var(v, index(v)));
  }
}

} // namespace render
