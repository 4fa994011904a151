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

Vec3d bezier(const std::array<Vec3, 4>& p, double v) {
  double s = 1 - v;
  return Vec3d(p[0]) * (s * s * s) + Vec3d(p[1]) * (3 * s * s * v) + Vec3d(p[2]) * (3 * s * v * v) +
         Vec3d(p[3]) * (v * v * v);
}

/// What turns a ribbon.
struct RibbonFacing {
  EyeInObject eye;
  bool by_normals = false;
  std::array<Vec3, 4> normals; ///< Bezier values; of a linear segment only the outer ones

  Vec3d at(double v, Vec3d centre) const {
    return by_normals ? bezier(normals, v) : Vec3d(eye.from(Vec3(centre)));
  }
};

class Ribbon final : public Geometry {
public:
  /// All by Bezier values.
  Ribbon(const std::array<Vec3, 4>& bezier, const std::array<float, 4>& widths, const RibbonFacing& facing)
      : p_(bezier), widths_(widths), facing_(facing) {}

  Box bound(const UvRect& r) const override {
    Box box;
    for (int j = 0; j < 4; ++j) // the blossom: control points of the part
      box.add(blossom(j > 0 ? r.v1 : r.v0, j > 1 ? r.v1 : r.v0, j > 2 ? r.v1 : r.v0));
    float widest = 0;
    for (float w : widths_)
      widest = std::max(widest, std::abs(w));
    box.grow(0.5f * widest);
    return box;
  }

  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    out.resize(at.size());
    auto column = [](float u) { return u - 0.5; };
    auto row = [&](float v) {
      constexpr double kStep = 1e-4;
      return Row{section(v), section(v - kStep), section(v + kStep), 2 * kStep};
    };
    at.for_each(column, row, [&](size_t k, double x, const Row& r) {
      out.P.set(k, Vec3(r.here.at(x)));
      out.dPdu.set(k, Vec3(r.here.side));
      out.dPdv.set(k, Vec3((r.after.at(x) - r.before.at(x)) / r.step));
      Vec3d n = glm::cross(r.here.side, r.here.tangent);
      out.N.set(k, Vec3(glm::length(n) > 0 ? glm::normalize(n) : r.here.facing));
    });
  }
  static constexpr std::array<int, 2> kCoarsest{1, 4};
  std::array<int, 2> coarsest() const override { return kCoarsest; }

private:
  struct Section {
    Vec3d centre, side, tangent, facing;
    Vec3d at(double x) const { return centre + side * x; }
  };
  struct Row {
    Section here, before, after;
    double step; ///< from before to after
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
    out.centre = bezier(p_, v);
    out.tangent = ((p[1] - p[0]) * (s * s) + (p[2] - p[1]) * (2 * s * v) + (p[3] - p[2]) * (v * v)) * 3.0;
    // Doubled end points: the direction a little inside, or of the chord.
    double size = glm::length(p[3] - p[0]) + glm::length(p[2] - p[1]);
    if (glm::length(out.tangent) < 1e-7 * size) {
      double w = v + (0.5 - v) * 1e-3, r = 1 - w;
      out.tangent = ((p[1] - p[0]) * (r * r) + (p[2] - p[1]) * (2 * r * w) + (p[3] - p[2]) * (w * w)) * 3.0;
    }
    out.facing = facing_.at(v, out.centre);
    double width =
        static_cast<double>(widths_[0]) * (s * s * s) + static_cast<double>(widths_[1]) * (3 * s * s * v) +
        static_cast<double>(widths_[2]) * (3 * s * v * v) + static_cast<double>(widths_[3]) * (v * v * v);
    out.side = across(out.tangent, out.facing) * width;
    return out;
  }

  std::array<Vec3, 4> p_;
  std::array<float, 4> widths_;
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
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    out.resize(at.size());
    at.for_each([&](size_t k, float ui, float vj) {
      float a = 2 * ui - 1, b = 2 * vj - 1;
      float ra = std::sqrt(1 - a * a / 2), rb = std::sqrt(1 - b * b / 2);
      out.P.set(k, centre_ + x_ * (a * rb) + y_ * (b * ra));
      out.dPdu.set(k, 2.0f * (x_ * rb - y_ * (b * a / (2 * ra))));
      out.dPdv.set(k, 2.0f * (y_ * ra - x_ * (a * b / (2 * rb))));
      out.N.set(k, glm::cross(x_, y_));
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
  size_t points[4] = {};        ///< vertex values; two of a linear curve
  size_t corners[2] = {};       ///< varying values at its ends
  size_t before = 0, after = 0; ///< neighbours of a linear segment, or its own ends
  float v0 = 0, v1 = 1;
};

class CurveSet;

/// Segment `k` of curve `c`.
class CurvePiece final : public Geometry {
public:
  CurvePiece(const CurveSet& set, uint32_t c, uint32_t k) : set_(&set), c_(c), k_(k) {}
  Box bound(const UvRect& r) const override;
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;
  bool ruled() const override;
  std::array<int, 2> coarsest() const override;
  uint32_t c() const { return c_; }
  uint32_t k() const { return k_; }

private:
  const CurveSet* set_;
  uint32_t c_, k_;
};

class CurveSet final : public VarSource {
public:
  CurveSet(const CurveLayout& layout, std::span<const int> points_of_curve, std::vector<Vec3> P,
           std::vector<TypedParam> vars, const EyeInObject& eye);

  std::span<const CurvePiece> patches() const { return pieces_; }
  bool cubic() const { return layout_.cubic; }
  Segment segment(const CurvePiece& piece) const;
  Ribbon ribbon(const CurvePiece& piece) const;
  /// Of a linear curve.
  BilinearPatch strip(const CurvePiece& piece) const;

  bool differs_by_piece() const override { return differs_; }
  size_t count() const override { return vars_.size(); }
  PatchVar make(size_t index, uint32_t piece) const override;

private:
  size_t index_of(StorageClass c, const Segment& s, int end) const;
  /// Bezier values of a variable along a cubic segment, number by number of each.
  template <size_t N>
  std::array<std::array<float, N>, 4> along(const TypedParam& var, const Segment& s) const;
  /// The value at an end of a linear segment.
  const float* at_end(const TypedParam& var, const Segment& s, int end) const {
    return &var.numbers[index_of(var.declaration.storage, s, end) *
                        static_cast<size_t>(var.declaration.width())];
  }
  Vec3d facing(const Segment& s, int end) const {
    if (!normals_) return Vec3d(eye_.from(P_[s.points[end]]));
    const float* n = at_end(*normals_, s, end);
    return {n[0], n[1], n[2]};
  }

  CurveLayout layout_;
  Matrix4 to_bezier_;
  std::vector<uint32_t> first_point_, first_corner_; ///< of each curve, and the end
  std::vector<Vec3> P_;
  std::vector<TypedParam> vars_;
  EyeInObject eye_;
  const TypedParam *width_, *normals_;
  bool differs_;
  std::vector<CurvePiece> pieces_;
};

CurveSet::CurveSet(const CurveLayout& layout, std::span<const int> points_of_curve, std::vector<Vec3> P,
                   std::vector<TypedParam> vars, const EyeInObject& eye)
    : layout_(layout), to_bezier_(to_bezier(layout.basis)), P_(std::move(P)), vars_(std::move(vars)),
      eye_(eye), width_(find(vars_, "width", slvm::Type::kFloat)),
      normals_(find(vars_, "N", slvm::Type::kNormal)), differs_(has_own(vars_, StorageClass::kUniform)) {
  if (!width_) width_ = find(vars_, "constantwidth", slvm::Type::kFloat);
  size_t segments = 0;
  for (int n : points_of_curve)
    segments += static_cast<size_t>(layout_.segments(n));
  pieces_.reserve(segments);
  first_point_.reserve(points_of_curve.size() + 1);
  first_corner_.reserve(points_of_curve.size() + 1);
  uint32_t point = 0, corner = 0;
  for (size_t c = 0; c < points_of_curve.size(); ++c) {
    first_point_.push_back(point);
    first_corner_.push_back(corner);
    point += static_cast<uint32_t>(points_of_curve[c]);
    corner += static_cast<uint32_t>(layout_.varying(points_of_curve[c]));
    for (int k = 0; k < layout_.segments(points_of_curve[c]); ++k)
      pieces_.emplace_back(*this, static_cast<uint32_t>(c), static_cast<uint32_t>(k));
  }
  first_point_.push_back(point);
  first_corner_.push_back(corner);
}

Segment CurveSet::segment(const CurvePiece& piece) const {
  size_t c = piece.c();
  int k = static_cast<int>(piece.k()), points = static_cast<int>(first_point_[c + 1] - first_point_[c]),
      corners = static_cast<int>(first_corner_[c + 1] - first_corner_[c]);
  auto point = [&](int i) {
    i = layout_.periodic ? (i + points) % points : std::clamp(i, 0, points - 1);
    return first_point_[c] + static_cast<size_t>(i);
  };
  Segment s;
  s.curve = c;
  for (int i = 0; i < layout_.fewest(); ++i)
    s.points[i] = point(k * layout_.step() + i);
  for (int i = 0; i < 2; ++i)
    s.corners[i] = first_corner_[c] + static_cast<size_t>((k + i) % corners);
  s.before = point(k - 1);
  s.after = point(k + 2);
  auto segments = static_cast<float>(layout_.segments(points));
  s.v0 = static_cast<float>(k) / segments;
  s.v1 = static_cast<float>(k + 1) / segments;
  return s;
}

size_t CurveSet::index_of(StorageClass c, const Segment& s, int end) const {
  switch (c) {
  case StorageClass::kConstant: return 0;
  case StorageClass::kUniform: return s.curve;
  case StorageClass::kVertex: return s.points[end];
  default: return s.corners[end];
  }
}

template <size_t N>
std::array<std::array<float, N>, 4> CurveSet::along(const TypedParam& var, const Segment& s) const {
  std::array<std::array<float, N>, 4> out;
  if (var.declaration.storage == StorageClass::kVertex) {
    for (size_t c = 0; c < N; ++c)
      for (int i = 0; i < 4; ++i) {
        float sum = 0;
        for (size_t j = 0; j < 4; ++j)
          sum += to_bezier_(i, static_cast<int>(j)) * var.numbers[s.points[j] * N + c];
        out[static_cast<size_t>(i)][c] = sum;
      }
    return out;
  }
  const float *a = at_end(var, s, 0), *b = at_end(var, s, 1);
  for (size_t c = 0; c < N; ++c)
    for (size_t i = 0; i < 4; ++i)
      out[i][c] = a[c] + (b[c] - a[c]) * (static_cast<float>(i) / 3);
  return out;
}

Ribbon CurveSet::ribbon(const CurvePiece& piece) const {
  Segment s = segment(piece);
  std::array<Vec3, 4> points{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      points[static_cast<size_t>(i)] += to_bezier_(i, j) * P_[s.points[j]];
  std::array<float, 4> widths{1, 1, 1, 1};
  if (width_) {
    auto w = along<1>(*width_, s);
    for (size_t i = 0; i < 4; ++i)
      widths[i] = w[i][0];
  }
  RibbonFacing facing{eye_, normals_ != nullptr, {}};
  if (normals_) {
    auto n = along<3>(*normals_, s);
    for (size_t i = 0; i < 4; ++i)
      facing.normals[i] = {n[i][0], n[i][1], n[i][2]};
  }
  return Ribbon(points, widths, facing);
}

/// Half the section where two straight segments meet, mitred up to twice the width.
Vec3 joint(Vec3 before, Vec3 at, Vec3 after, Vec3d facing, int end) {
  auto unit = [](Vec3d d) { return glm::length(d) > 0 ? glm::normalize(d) : d; };
  Vec3d in = unit(Vec3d(at - before)), out = unit(Vec3d(after - at)), along = in + out;
  if (glm::length(along) < 1e-6) along = end == 0 ? out : in;
  double cosine = glm::length(in) > 0 && glm::length(out) > 0 ? glm::length(in + out) / 2 : 1;
  return Vec3(across(along, facing) * (0.5 / std::max(cosine, 0.5)));
}

BilinearPatch CurveSet::strip(const CurvePiece& piece) const {
  Segment s = segment(piece);
  Vec3 a = P_[s.points[0]], b = P_[s.points[1]];
  float first = width_ ? *at_end(*width_, s, 0) : 1, last = width_ ? *at_end(*width_, s, 1) : 1;
  Vec3 start = joint(P_[s.before], a, b, facing(s, 0), 0) * first,
       end = joint(a, b, P_[s.after], facing(s, 1), 1) * last;
  return BilinearPatch({a - start, a + start, b - end, b + end});
}

PatchVar CurveSet::make(size_t index, uint32_t piece) const {
  const TypedParam& var = vars_[index];
  const Declaration& d = var.declaration;
  Segment s = segment(pieces_[piece]);
  if (!interpolates(d.storage)) return constant_var(var, index_of(d.storage, s, 0));
  if (!layout_.cubic || d.storage != StorageClass::kVertex) {
    size_t a = index_of(d.storage, s, 0), b = index_of(d.storage, s, 1);
    return bilinear_var(var, {a, a, b, b});
  }
  std::array<size_t, 16> indices;
  for (size_t k = 0; k < 16; ++k)
    indices[k] = s.points[k / 4];
  return bicubic_var(var, indices, bezier_basis(), layout_.basis);
}

Box CurvePiece::bound(const UvRect& r) const {
  return set_->cubic() ? set_->ribbon(*this).bound(r) : set_->strip(*this).bound(r);
}

void CurvePiece::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  if (set_->cubic())
    set_->ribbon(*this).evaluate(at, out);
  else
    set_->strip(*this).evaluate(at, out);
}

bool CurvePiece::ruled() const {
  return !set_->cubic();
}

std::array<int, 2> CurvePiece::coarsest() const {
  return set_->cubic() ? Ribbon::kCoarsest : Geometry::coarsest();
}

class DiscSet;

class DiscPiece final : public Geometry {
public:
  DiscPiece(const DiscSet& set, size_t index) : set_(&set), index_(index) {}
  Box bound(const UvRect& r) const override;
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;
  std::array<int, 2> coarsest() const override { return {2, 2}; }

private:
  const DiscSet* set_;
  size_t index_;
};

class DiscSet final : public VarSource {
public:
  DiscSet(std::vector<Vec3> P, std::vector<TypedParam> vars, const EyeInObject& eye)
      : P_(std::move(P)), vars_(std::move(vars)), eye_(eye),
        width_(find(vars_, "width", slvm::Type::kFloat)) {
    if (!width_) width_ = find(vars_, "constantwidth", slvm::Type::kFloat);
    for (size_t i = 0; i < P_.size(); ++i)
      pieces_.emplace_back(*this, i);
  }
  std::span<const DiscPiece> patches() const { return pieces_; }
  Disc disc(size_t i) const {
    float radius = 0.5f * (width_ ? width_->numbers[value_of(*width_, i)] : 1);
    Vec3d facing(eye_.from(P_[i]));
    Vec3d x = across(Vec3d(0, 1, 0), facing), y = across(facing, x);
    return Disc(P_[i], Vec3(x) * radius, Vec3(y) * radius);
  }
  size_t count() const override { return vars_.size(); }
  PatchVar make(size_t var, uint32_t piece) const override {
    return constant_var(vars_[var], value_of(vars_[var], piece));
  }

private:
  static size_t value_of(const TypedParam& v, size_t i) {
    return interpolates(v.declaration.storage) ? i : 0;
  }

  std::vector<Vec3> P_;
  std::vector<TypedParam> vars_;
  EyeInObject eye_;
  const TypedParam* width_;
  std::vector<DiscPiece> pieces_;
};

Box DiscPiece::bound(const UvRect& r) const {
  return set_->disc(index_).bound(r);
}
void DiscPiece::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  set_->disc(index_).evaluate(at, out);
}

} // namespace

void add_curves(const CurveLayout& layout, std::span<const int> points_of_curve, std::vector<Vec3> P,
                std::vector<TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out) {
  auto set = std::make_shared<CurveSet>(layout, points_of_curve, std::move(P), std::move(vars), eye);
  const bool hair = state->attributes->dicing.hair;
  out.add(state, pieces_of(set, [at = set.get(), hair](uint32_t k, Primitive& primitive) {
            Segment s = at->segment(at->patches()[k]);
            primitive.uv = {0, 1, s.v0, s.v1};
            primitive.one_across = hair;
          }));
}

void add_points(std::vector<Vec3> P, std::vector<TypedParam> vars, const EyeInObject& eye,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out) {
  out.add(state, pieces_of(std::make_shared<DiscSet>(std::move(P), std::move(vars), eye)));
}

} // namespace render
