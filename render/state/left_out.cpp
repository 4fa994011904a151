// Taking elements out of lists of faces and curves.
#include "render/state/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// Places of a list that stay, in runs.
class Kept {
public:
  void add(size_t first, size_t count) {
    if (!runs_.empty() && runs_.back().first + runs_.back().count == first)
      runs_.back().count += count;
    else
      runs_.push_back({first, count});
  }
  /// Each place is `width` values.
  template <class T> void apply(std::vector<T>& list, size_t width = 1) const {
    auto to = list.begin();
    for (const Run& r : runs_) {
      auto from = list.begin() + static_cast<std::ptrdiff_t>(r.first * width);
      to = std::move(from, from + static_cast<std::ptrdiff_t>(r.count * width), to);
    }
    list.erase(to, list.end());
  }
  void apply(TypedParam& var) const {
    const auto width = static_cast<size_t>(var.declaration.width());
    if (!var.numbers.empty()) apply(var.numbers, width);
    if (!var.strings.empty()) apply(var.strings, width);
  }

private:
  struct Run {
    size_t first, count;
  };
  std::vector<Run> runs_;
};

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Why a face cannot be drawn, or nothing.
std::string trouble(std::span<const int> loops, std::span<const int> vertices, std::span<const Vec3> P) {
  for (int n : loops)
    if (n < 3) return fmt::format("has {} {}", n, n == 1 ? "vertex" : "vertices");
  for (int v : vertices) {
    if (v < 0 || static_cast<size_t>(v) >= P.size())
      return fmt::format("has the vertex {}, and there are {}", v, P.size());
    if (!is_finite(P[static_cast<size_t>(v)])) return fmt::format("has a point that is not finite, {}", v);
  }
  return {};
}

void count(LeftOut& out, size_t element, std::string why) {
  if (out.count++ > 0) return;
  out.first = element;
  out.first_why = std::move(why);
}

} // namespace

LeftOut leave_out_bad_faces(PolygonFaces& faces, std::span<const Vec3> P, std::vector<TypedParam>& vars,
                            std::vector<int>* tagged_faces) {
  LeftOut out;
  out.all = faces.loops_of_face.empty() ? faces.loops.size() : faces.loops_of_face.size();
  Kept kept, loops, corners;
  std::vector<int> number; // of each face afterwards; -1: it is left out
  int next = 0;
  size_t loop = 0, first = 0;
  for (size_t f = 0; f < out.all; ++f) {
    const size_t n = faces.loops_of_face.empty() ? 1 : static_cast<size_t>(faces.loops_of_face[f]);
    const std::span<const int> own(faces.loops.data() + loop, n);
    size_t size = 0;
    for (int k : own)
      size += static_cast<size_t>(k);
    std::string why = trouble(own, std::span<const int>(faces.vertices).subspan(first, size), P);
    number.push_back(why.empty() ? next++ : -1);
    if (why.empty()) {
      kept.add(f, 1);
      loops.add(loop, n);
      corners.add(first, size);
    } else {
      count(out, f, std::move(why));
    }
    loop += n;
    first += size;
  }
  if (out.count == 0) return out;
  if (!faces.loops_of_face.empty()) kept.apply(faces.loops_of_face);
  loops.apply(faces.loops);
  corners.apply(faces.vertices);
  for (TypedParam& v : vars) {
    if (v.declaration.storage == StorageClass::kUniform) kept.apply(v);
    if (v.declaration.storage == StorageClass::kFaceVarying) corners.apply(v);
  }
  if (tagged_faces) {
    for (int& f : *tagged_faces)
      f = number[static_cast<size_t>(f)];
    std::erase(*tagged_faces, -1);
  }
  return out;
}

LeftOut leave_out_bad_curves(const CurveLayout& layout, std::vector<int>& points_of_curve,
                             std::vector<Vec3>& P, std::vector<TypedParam>& vars) {
  LeftOut out;
  out.all = points_of_curve.size();
  Kept kept, points, corners;
  size_t point = 0, corner = 0;
  for (size_t c = 0; c < out.all; ++c) {
    const int n = points_of_curve[c];
    const auto size = static_cast<size_t>(n), ends = static_cast<size_t>(layout.varying(n));
    const std::span<const Vec3> own(P.data() + point, size);
    const auto bad = std::find_if_not(own.begin(), own.end(), is_finite);
    if (n < layout.fewest()) {
      count(out, c,
            fmt::format("has {} {}, where {} are needed", n, n == 1 ? "point" : "points", layout.fewest()));
    } else if (bad != own.end()) {
      count(out, c, fmt::format("has a point that is not finite, {}", bad - own.begin()));
    } else {
      kept.add(c, 1);
      points.add(point, size);
      corners.add(corner, ends);
    }
    point += size;
    corner += ends;
  }
  if (out.count == 0) return out;
  kept.apply(points_of_curve);
  points.apply(P);
  for (TypedParam& v : vars)
    switch (v.declaration.storage) {
    case StorageClass::kConstant: break;
    case StorageClass::kUniform: kept.apply(v); break;
    case StorageClass::kVertex: points.apply(v); break;
    default: corners.apply(v);
    }
  return out;
}

} // namespace render
