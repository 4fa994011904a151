// Blobbies as quadrilaterals, by surface nets (Gibson 1998): one vertex in each cell of a lattice that the
// surface passes through, moved onto the surface; one quadrilateral across each lattice edge that crosses it.
#include "render/prims/blobby.h"
#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

#include <cmath>

namespace render {

namespace {

using Vec3d = glm::dvec3;

/// A bilinear patch with the normals of the smooth surface it stands for.
class SmoothQuad final : public Geometry {
public:
  SmoothQuad(const std::array<Vec3, 4>& points, const std::array<Vec3, 4>& normals)
      : flat_(points), normals_(normals) {}
  Box bound(const UvRect& r) const override { return flat_.bound(r); }
  bool ruled() const override { return true; }
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override {
    flat_.evaluate(at, out);
    at.for_each([&](size_t k, float a, float b) {
      out.N[k] =
          (normals_[0] * (1 - a) + normals_[1] * a) * (1 - b) + (normals_[2] * (1 - a) + normals_[3] * a) * b;
    });
  }

private:
  BilinearPatch flat_;
  std::array<Vec3, 4> normals_;
};

class NetMaker {
public:
  NetMaker(const BlobbyField& field, float wanted, std::span<const TypedParam> vars)
      : field_(field), vars_(vars) {
    Box box = field.bound();
    Vec3d size(box.max - box.min);
    constexpr double kMostAcross = 24, kFewestAcross = 12, kMostWork = 3e8, kMostCells = 6e6;
    double most = std::min(kMostCells, kMostWork / static_cast<double>(field.leaves() + 1));
    auto smallest = static_cast<double>(field.smallest());
    cell_ = std::clamp(static_cast<double>(wanted), smallest / kMostAcross, smallest / kFewestAcross);
    auto cells = [&](double c) { return (size.x / c + 3) * (size.y / c + 3) * (size.z / c + 3); };
    cell_ = std::max(cell_, 1e-6 * std::max({size.x, size.y, size.z}));
    while (cells(cell_) > most)
      cell_ *= 1.1;
    origin_ = Vec3d(box.min) - Vec3d(1.01 * cell_); // a margin, so that the surface closes
    for (int c = 0; c < 3; ++c)
      n_[c] = static_cast<size_t>(std::ceil(size[c] / cell_)) + 4;
  }

  void run(const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out) {
    sample();
    place_vertices();
    for (size_t k = 1; k + 1 < n_[2]; ++k)
      for (size_t j = 1; j + 1 < n_[1]; ++j)
        for (size_t i = 1; i + 1 < n_[0]; ++i)
          for (int axis = 0; axis < 3; ++axis)
            add_quad({i, j, k}, axis, state, out);
  }

private:
  static constexpr double kOnSurface = 1e-3; ///< difference of fields that does not show
  struct Vertex {
    Vec3 P, N;
    std::vector<double> shares; ///< of the leaves; they add up to 1
  };
  using Place = std::array<size_t, 3>;

  size_t index(const Place& p) const { return (p[2] * n_[1] + p[1]) * n_[0] + p[0]; }
  Vec3d position(const Place& p) const {
    return origin_ +
           cell_ * Vec3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }

  /// Calls f(part, place) for all places of the lattice, less `margin` at its far sides, block by block: only
  /// a few leaves reach each block. `part` has the field of the block and of a cell around it.
  template <class F> void for_each(size_t margin, F&& f) const {
    constexpr size_t kBlock = 8;
    Place from;
    for (from[2] = 0; from[2] + margin < n_[2]; from[2] += kBlock)
      for (from[1] = 0; from[1] + margin < n_[1]; from[1] += kBlock)
        for (from[0] = 0; from[0] + margin < n_[0]; from[0] += kBlock) {
          Place to;
          for (size_t c = 0; c < 3; ++c)
            to[c] = std::min(from[c] + kBlock, n_[c] - margin);
          Box box;
          box.add(Vec3(position(from) - Vec3d(1.5 * cell_)));
          box.add(Vec3(position(to) + Vec3d(1.5 * cell_)));
          BlobbyField part = field_.near(box);
          Place p;
          for (p[2] = from[2]; p[2] < to[2]; ++p[2])
            for (p[1] = from[1]; p[1] < to[1]; ++p[1])
              for (p[0] = from[0]; p[0] < to[0]; ++p[0])
                f(part, p);
        }
  }

  void sample() {
    samples_.resize(n_[0] * n_[1] * n_[2]);
    for_each(0, [&](const BlobbyField& part, const Place& p) {
      samples_[index(p)] = static_cast<float>(part.at(position(p)) - BlobbyField::kThreshold);
    });
  }

  void place_vertices() {
    vertex_of_.assign(samples_.size(), -1);
    for_each(1, [&](const BlobbyField& part, const Place& p) {
      Vec3d sum(0.0);
      int crossings = 0;
      for (int axis = 0; axis < 3; ++axis)
        for (size_t side = 0; side < 4; ++side) {
          Place a = p;
          a[static_cast<size_t>((axis + 1) % 3)] += side & 1;
          a[static_cast<size_t>((axis + 2) % 3)] += side >> 1;
          Place b = a;
          ++b[static_cast<size_t>(axis)];
          float fa = samples_[index(a)], fb = samples_[index(b)];
          if ((fa > 0) == (fb > 0)) continue;
          sum += glm::mix(position(a), position(b), static_cast<double>(fa / (fa - fb)));
          ++crossings;
        }
      if (crossings == 0) return;
      vertex_of_[index(p)] = static_cast<int>(vertices_.size());
      vertices_.push_back(vertex(part, sum / static_cast<double>(crossings)));
    });
  }

  /// A point of the surface on a line through `start`, at most a cell away from it, where the field is too
  /// steep for Newton's steps; `otherwise` if the line stays on one side.
  Vec3d bisected(const BlobbyField& field, Vec3d start, Vec3d otherwise) const {
    Vec3d direction = field.outwards(start, 1e-3 * cell_);
    auto inside = [&](double t) { return field.at(start + direction * t) > BlobbyField::kThreshold; };
    bool here = inside(0);
    double low = 0, high = here ? cell_ : -cell_;
    if (inside(high) == here) return otherwise;
    for (int i = 0; i < 24; ++i) {
      double middle = 0.5 * (low + high);
      (inside(middle) == here ? low : high) = middle;
    }
    return start + direction * low;
  }

  /// Moves a point onto the surface, by at most a cell.
  Vertex vertex(const BlobbyField& field, Vec3d start) const {
    double step = 1e-3 * cell_;
    Vec3d p = start;
    for (int i = 0; i < 4; ++i) {
      Vec3d direction = field.outwards(p, step);
      double slope = (field.at(p + direction * step) - field.at(p - direction * step)) / (2 * step);
      if (!(slope < 0)) break;
      Vec3d next = p + direction * ((BlobbyField::kThreshold - field.at(p)) / slope);
      if (!(glm::distance(next, start) < cell_)) break;
      p = next;
    }
    if (std::abs(field.at(p) - BlobbyField::kThreshold) > kOnSurface) p = bisected(field, start, p);
    Vertex out{Vec3(p), Vec3(field.outwards(p, step)), {}};
    if (vars_.empty()) return out;
    out.shares.resize(field_.leaves());
    field_.shares(p, out.shares);
    return out;
  }

  /// The quadrilateral across the edge from `p` along `axis`; its outside is where the field is low.
  void add_quad(const Place& p, int axis, const std::shared_ptr<const PrimitiveState>& state,
                std::vector<Primitive>& out) const {
    Place end = p;
    ++end[static_cast<size_t>(axis)];
    bool inside = samples_[index(p)] > 0;
    if (inside == (samples_[index(end)] > 0)) return;
    auto u = static_cast<size_t>((axis + 1) % 3), v = static_cast<size_t>((axis + 2) % 3);
    if (!inside) std::swap(u, v);
    std::array<const Vertex*, 4> corners{};
    for (size_t c = 0; c < 4; ++c) {
      Place cell = p;
      cell[u] -= c & 1 ? 0 : 1;
      cell[v] -= c & 2 ? 0 : 1;
      corners[c] = &vertices_[static_cast<size_t>(vertex_of_[index(cell)])];
    }
    Primitive& primitive = out.emplace_back();
    primitive.state = state;
    primitive.geometry =
        std::make_shared<SmoothQuad>(std::array{corners[0]->P, corners[1]->P, corners[2]->P, corners[3]->P},
                                     std::array{corners[0]->N, corners[1]->N, corners[2]->N, corners[3]->N});
    for (const TypedParam& var : vars_)
      primitive.vars.push_back(mixed(var, corners));
  }

  PatchVar mixed(const TypedParam& source, const std::array<const Vertex*, 4>& corners) const {
    if (!interpolates(source.declaration.storage)) return constant_var(source, 0);
    PatchVar var = var_head(source);
    var.interpolation = Interpolation::kBilinear;
    std::vector<float> values;
    size_t width = var.width();
    for (size_t i = 0; i < field_.leaves(); ++i)
      append_value(source, i, values);
    for (const Vertex* v : corners)
      for (size_t c = 0; c < width; ++c) {
        double sum = 0;
        for (size_t i = 0; i < field_.leaves(); ++i)
          sum += v->shares[i] * static_cast<double>(values[i * width + c]);
        var.values.push_back(static_cast<float>(sum));
      }
    return var;
  }

  const BlobbyField& field_;
  std::span<const TypedParam> vars_;
  double cell_ = 1;
  Vec3d origin_{0.0};
  std::array<size_t, 3> n_{};
  std::vector<float> samples_;
  std::vector<int> vertex_of_;
  std::vector<Vertex> vertices_;
};

} // namespace

void add_blobby(const BlobbyField& field, float wanted, std::span<const TypedParam> vars,
                const std::shared_ptr<const PrimitiveState>& state, std::vector<Primitive>& out) {
  if (field.bound().empty()) return; // constants only: no surface anywhere
  NetMaker(field, wanted, vars).run(state, out);
}

} // namespace render
