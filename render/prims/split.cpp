// Bound, cull, split.
#include "render/prims/split.h"

#include "render/prims/micropolygon_size.h"

#include <cmath>

namespace render {

namespace {

/// Segments of the lattice that measures how large a piece is in the image.
constexpr int kProbes = 4;
/// A piece this small in u or v is never split further: its sides would not be distinct floats.
constexpr float kSmallest = 1e-6f;
/// Pieces of one primitive that are looked at: beyond, in a scene gone wrong, they are diced as they are.
constexpr size_t kMostPieces = size_t{1} << 21;
constexpr size_t kCostOfHuge = 128;
/// Of a side of a piece; a product of two is still an int.
constexpr int kMostSegments = 1 << 14;

struct Piece {
  UvRect rect;
  int eye_splits = 0;
};

/// The corners of a box in camera space on the raster, in homogeneous coordinates; hence also of boxes that
/// reach behind the eye. All corners at once, in vectors.
struct RasterCorners {
  static constexpr int kCount = 8;
  float x[kCount], y[kCount], w[kCount];

  RasterCorners(const Box& box, const Matrix4& to_raster) {
    const auto& m = to_raster.m;
    float X[kCount], Y[kCount], Z[kCount];
    for (int i = 0; i < kCount; ++i) {
      const Vec3 p = box.corner(i);
      X[i] = p.x, Y[i] = p.y, Z[i] = p.z;
    }
    for (int i = 0; i < kCount; ++i) {
      x[i] = X[i] * m[0] + Y[i] * m[4] + Z[i] * m[8] + m[12];
      y[i] = X[i] * m[1] + Y[i] * m[5] + Z[i] * m[9] + m[13];
      w[i] = X[i] * m[3] + Y[i] * m[7] + Z[i] * m[11] + m[15];
    }
  }
  /// Whether all of them are on the outer side of one side plane of the pyramid that is seen as [low, high].
  bool outside(Vec2 low, Vec2 high) const {
    int left = 0, right = 0, top = 0, bottom = 0;
    for (int i = 0; i < kCount; ++i) {
      left += x[i] < low.x * w[i];
      right += x[i] > high.x * w[i];
      top += y[i] < low.y * w[i];
      bottom += y[i] > high.y * w[i];
    }
    return std::max(std::max(left, right), std::max(top, bottom)) == kCount;
  }
  /// Around all of them, which are in front of the eye.
  void bound(Vec2& low, Vec2& high) const {
    float rx[kCount], ry[kCount];
    for (int i = 0; i < kCount; ++i) {
      rx[i] = x[i] / w[i];
      ry[i] = y[i] / w[i];
    }
    low = high = {rx[0], ry[0]};
    for (int i = 1; i < kCount; ++i) {
      low = glm::min(low, Vec2(rx[i], ry[i]));
      high = glm::max(high, Vec2(rx[i], ry[i]));
    }
  }
};

struct Extent {
  float u = 0, v = 0; ///< longest row and column of the probing lattice
};

class Splitter {
public:
  Splitter(const Primitive& primitive, uint32_t index, const SplitSettings& settings,
           std::vector<GridTask>& out)
      : primitive_(primitive), index_(index), settings_(settings), camera_(*settings.camera), out_(out),
        step_(micropolygon_side(primitive, camera_, settings.motion)),
        dicing_(primitive.attributes().dicing) {}

  void run() {
    stack_.push_back({});
    while (!stack_.empty()) {
      Piece piece = stack_.back();
      stack_.pop_back();
      visit(piece);
    }
  }

private:
  void visit(const Piece& piece);
  Extent measure(const UvRect& rect, bool in_raster);
  int segments(float wanted, float fewest) const;
  void split(const Piece& piece, bool along_u, int eye_splits);

  const Primitive& primitive_;
  uint32_t index_;
  const SplitSettings& settings_;
  const Camera& camera_;
  std::vector<GridTask>& out_;
  float step_; ///< side of a micropolygon in pixels
  const Dicing& dicing_;
  std::vector<Piece> stack_;
  size_t pieces_ = 0;
  SurfaceLattice lattice_; ///< of the piece being measured
};

void Splitter::visit(const Piece& piece) {
  ++pieces_;
  Box box = primitive_.camera_bound(piece.rect);
  // A box that is not a number is of no use to anyone; the negated test catches it.
  // Surfaces of solids count also where they are too far to be seen.
  bool too_far = !(box.min.z <= camera_.far_plane()) && !primitive_.state->solid;
  if (!(box.max.z >= camera_.near_plane()) || too_far) return;
  const RasterCorners corners(box, camera_.to_raster());
  // Out of focus, a box outside the pyramid may be seen: its raster bound decides.
  if (camera_.perspective() && !camera_.has_lens() &&
      corners.outside(settings_.raster_min, settings_.raster_max))
    return;

  // Pieces that reach behind the near plane cannot be projected: split them until the rest is out of the
  // picture.
  bool crosses_eye = camera_.perspective() && box.min.z < camera_.near_plane();
  if (crosses_eye && piece.eye_splits < settings_.eye_splits && pieces_ <= kMostPieces) {
    Extent e = measure(piece.rect, false);
    split(piece, e.u >= e.v, piece.eye_splits + 1);
    return;
  }
  GridTask task;
  task.primitive = index_;
  task.rect = piece.rect;
  task.zmin = std::max(box.min.z, camera_.near_plane());
  task.zmax = box.max.z;
  task.raster_min = settings_.raster_min;
  task.raster_max = settings_.raster_max;
  if (!crosses_eye) {
    corners.bound(task.raster_min, task.raster_max);
    const Vec2 blur = camera_.blur(std::max(box.min.z, camera_.near_plane()), box.max.z);
    task.raster_min -= blur;
    task.raster_max += blur;
    if (!(task.raster_max.x >= settings_.raster_min.x) || !(task.raster_min.x <= settings_.raster_max.x) ||
        !(task.raster_max.y >= settings_.raster_min.y) || !(task.raster_min.y <= settings_.raster_max.y))
      return;
    if (settings_.may_have_samples && primitive_.attributes().cull_hidden &&
        !settings_.may_have_samples(task.raster_min, task.raster_max) &&
        !(settings_.must_be_shaded && settings_.must_be_shaded(primitive_)))
      return;
  }
  Extent e = measure(piece.rect, true);
  float width = piece.rect.u1 - piece.rect.u0, height = piece.rect.v1 - piece.rect.v0;
  auto fewest = primitive_.geometry->coarsest();
  int nu = segments(e.u / step_, width * static_cast<float>(fewest[0])),
      nv = segments(e.v / step_, height * static_cast<float>(fewest[1]));
  if (primitive_.one_across) nu = 1;
  // Pieces larger than any image come a few at a time, or there is no end to them.
  if (std::max(nu, nv) == kMostSegments) pieces_ += kCostOfHuge;
  bool too_small = width < kSmallest || height < kSmallest || pieces_ > kMostPieces;
  if (nu * nv > settings_.grid_size && !crosses_eye && !too_small) {
    split(piece, nu > nv || (nu == nv && width >= height), piece.eye_splits);
    return;
  }
  // What cannot be split any more is diced as finely as one grid allows.
  while (nu * nv > settings_.grid_size)
    (nu >= nv ? nu : nv) = std::max(nu, nv) / 2;
  task.step = step_;
  task.nu = nu + 1;
  task.nv = nv + 1;
  out_.push_back(task);
}

/// Segments for a side that is `wanted` micropolygons long. Curved surfaces take powers of two, so that
/// neighbouring grids can agree on their outlines (stitch.h); the side of a micropolygon is then 0.66 to 1.32
/// of what was asked for. Attribute "dice" "binary" asks for the same of others.
int Splitter::segments(float wanted, float fewest) const {
  bool ruled = primitive_.geometry->ruled();
  if (ruled && !dicing_.binary)
    return static_cast<int>(std::clamp(std::ceil(wanted), 1.0f, float{kMostSegments}));
  if (ruled) fewest = 1;
  constexpr float kStretch = 1.32f;
  int n = 1;
  while (n < kMostSegments && (static_cast<float>(n) * kStretch < wanted || fewest > static_cast<float>(n)))
    n *= 2;
  return n;
}

void Splitter::split(const Piece& piece, bool along_u, int eye_splits) {
  Piece a{piece.rect, eye_splits}, b{piece.rect, eye_splits};
  if (along_u)
    a.rect.u1 = b.rect.u0 = piece.rect.umid();
  else
    a.rect.v1 = b.rect.v0 = piece.rect.vmid();
  stack_.push_back(b);
  stack_.push_back(a);
}

/// Longest row and column of a coarse lattice, in pixels or (for pieces behind the eye) in camera space.
/// Where orientation is not to count, a line of the lattice is as long as if it faced the eye.
Extent Splitter::measure(const UvRect& rect, bool in_raster) {
  int segments = primitive_.geometry->ruled() ? 1 : kProbes;
  int n = segments + 1;
  float u[kProbes + 1], v[kProbes + 1];
  for (int i = 0; i < n; ++i) {
    float t = static_cast<float>(i) / static_cast<float>(segments);
    u[i] = rect.u0 + t * (rect.u1 - rect.u0);
    v[i] = rect.v0 + t * (rect.v1 - rect.v0);
  }
  auto count = static_cast<size_t>(n);
  primitive_.geometry->find_points({{u, count}, {v, count}}, lattice_);
  Vec3 p[(kProbes + 1) * (kProbes + 1)], there[(kProbes + 1) * (kProbes + 1)];
  for (size_t k = 0; k < lattice_.P.size(); ++k) {
    p[k] = transform_point(primitive_.state->object_to_camera, lattice_.P[k]);
    if (!in_raster) continue;
    if (camera_.perspective()) p[k].z = std::max(p[k].z, camera_.near_plane());
    there[k] = p[k];
    p[k] = Vec3(camera_.project(p[k]), 0);
  }
  auto length = [&](int a, int b) {
    float seen = glm::distance(p[a], p[b]);
    if (!in_raster || dicing_.raster_oriented) return seen;
    float z = 0.5f * (there[a].z + there[b].z);
    return std::max(seen, glm::distance(there[a], there[b]) * camera_.pixels_per_unit(z));
  };
  Extent e;
  for (int j = 0; j < n; ++j) {
    float row = 0, column = 0;
    for (int i = 0; i < segments; ++i) {
      row += length(j * n + i, j * n + i + 1);
      column += length(i * n + j, (i + 1) * n + j);
    }
    e.u = std::max(e.u, row);
    e.v = std::max(e.v, column);
  }
  return e;
}

} // namespace

void split_primitive(const Primitive& primitive, uint32_t index, const SplitSettings& settings,
                     std::vector<GridTask>& out) {
  if (primitive.attributes().rays.camera) Splitter(primitive, index, settings, out).run();
}

} // namespace render
