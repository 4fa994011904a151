// Blobbies as quadrilaterals, by surface nets (Gibson 1998): one vertex in each cell of a lattice that the
// surface passes through, moved onto the surface; one quadrilateral across each lattice edge that crosses it.
#include "render/prims/blobby.h"
#include "render/prims/patches.h"
#include "render/prims/typed_vars.h"

#include <cmath>

namespace render {

namespace {

using Vec3d = glm::dvec3;

/// The net: vertices, and quadrilaterals of them, corners as those of a bilinear patch.
struct Net {
  std::vector<Vec3> P, N;
  std::vector<std::vector<float>> values; ///< of each variable that interpolates, vertex by vertex
  std::vector<std::array<uint32_t, 4>> quads;
};

class BlobbyMesh;

/// A bilinear patch with the normals of the smooth surface it stands for.
class SmoothQuad final : public Geometry {
public:
  SmoothQuad(const BlobbyMesh& mesh, uint32_t quad) : mesh_(&mesh), quad_(quad) {}
  Box bound(const UvRect& r) const override { return flat().bound(r); }
  bool ruled() const override { return true; }
  void evaluate(const UvPoints& at, SurfaceLattice& out) const override;

private:
  BilinearPatch flat() const;

  const BlobbyMesh* mesh_;
  uint32_t quad_;
};

class BlobbyMesh final : public VarSource {
public:
  BlobbyMesh(Net net, std::span<const TypedParam> vars)
      : net_(std::move(net)), vars_(vars.begin(), vars.end()) {
    patches_.reserve(net_.quads.size());
    for (uint32_t k = 0; k < net_.quads.size(); ++k)
      patches_.emplace_back(*this, k);
  }
  std::span<const SmoothQuad> patches() const { return patches_; }
  std::array<Vec3, 4> corners(const std::vector<Vec3>& of, uint32_t quad) const {
    const auto& q = net_.quads[quad];
    return {of[q[0]], of[q[1]], of[q[2]], of[q[3]]};
  }
  std::array<Vec3, 4> points(uint32_t quad) const { return corners(net_.P, quad); }
  std::array<Vec3, 4> normals(uint32_t quad) const { return corners(net_.N, quad); }

  size_t count() const override { return vars_.size(); }
  bool differs_by_piece() const override { return false; } // one value for the whole Blobby
  PatchVar make(size_t index, uint32_t piece) const override {
    const TypedParam& source = vars_[index];
    if (!interpolates(source.declaration.storage)) return constant_var(source, 0);
    PatchVar var = var_head(source);
    var.interpolation = Interpolation::kBilinear;
    for (uint32_t vertex : net_.quads[piece]) {
      auto first = net_.values[index].begin() + static_cast<std::ptrdiff_t>(vertex * var.width());
      var.values.insert(var.values.end(), first, first + static_cast<std::ptrdiff_t>(var.width()));
    }
    return var;
  }

private:
  Net net_;
  std::vector<TypedParam> vars_;
  std::vector<SmoothQuad> patches_;
};

BilinearPatch SmoothQuad::flat() const {
  return BilinearPatch(mesh_->points(quad_));
}

void SmoothQuad::evaluate(const UvPoints& at, SurfaceLattice& out) const {
  flat().evaluate(at, out);
  const std::array<Vec3, 4> n = mesh_->normals(quad_);
  at.for_each([&](size_t k, float a, float b) {
    out.N.set(k, (n[0] * (1 - a) + n[1] * a) * (1 - b) + (n[2] * (1 - a) + n[3] * a) * b);
  });
}

class NetMaker {
public:
  NetMaker(const BlobbyField& field, float wanted, std::span<const TypedParam> vars)
      : field_(field), leaf_values_(vars.size()), shares_(vars.empty() ? 0 : field.leaves()) {
    for (const TypedParam& var : vars)
      places_.push_back(var.declaration.mpoint);
    for (size_t v = 0; v < vars.size(); ++v)
      for (size_t i = 0; i < field.leaves() && interpolates(vars[v].declaration.storage); ++i)
        append_value(vars[v], i, leaf_values_[v]);
    net_.values.resize(vars.size());
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

  Net run() {
    sample();
    place_vertices();
    for (size_t k = 1; k + 1 < n_[2]; ++k)
      for (size_t j = 1; j + 1 < n_[1]; ++j)
        for (size_t i = 1; i + 1 < n_[0]; ++i)
          for (int axis = 0; axis < 3; ++axis)
            add_quad({i, j, k}, axis);
    return std::move(net_);
  }

private:
  static constexpr double kOnSurface = 1e-3; ///< difference of fields that does not show
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
      vertex_of_[index(p)] = static_cast<int>(net_.P.size());
      add_vertex(part, sum / static_cast<double>(crossings));
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
  void add_vertex(const BlobbyField& field, Vec3d start) {
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
    net_.P.emplace_back(p);
    net_.N.emplace_back(field.outwards(p, step));
    if (!shares_.empty()) mix(p);
  }

  /// The values of the variables at a vertex: those of the leaves, by their shares in the field.
  void mix(Vec3d p) {
    field_.shares(p, shares_);
    for (size_t v = 0; v < leaf_values_.size(); ++v) {
      if (places_[v]) {
        place(v, p);
        continue;
      }
      size_t width = leaf_values_[v].size() / shares_.size();
      for (size_t c = 0; c < width; ++c) {
        double sum = 0;
        for (size_t i = 0; i < shares_.size(); ++i)
          sum += shares_[i] * static_cast<double>(leaf_values_[v][i * width + c]);
        net_.values[v].push_back(static_cast<float>(sum));
      }
    }
  }

  /// Where the point would be if the leaves stood where these matrices put them.
  void place(size_t var, Vec3d p) {
    Vec3d sum(0.0);
    for (size_t i = 0; i < shares_.size(); ++i) {
      if (shares_[i] == 0) continue;
      Matrix4 m;
      std::copy_n(leaf_values_[var].begin() + static_cast<std::ptrdiff_t>(16 * i), 16, m.m.begin());
      sum += shares_[i] * Vec3d(transform_point(m, Vec3(field_.in_leaf(i, p))));
    }
    for (int c = 0; c < 3; ++c)
      net_.values[var].push_back(static_cast<float>(sum[c]));
  }

  /// The quadrilateral across the edge from `p` along `axis`; its outside is where the field is low.
  void add_quad(const Place& p, int axis) {
    Place end = p;
    ++end[static_cast<size_t>(axis)];
    bool inside = samples_[index(p)] > 0;
    if (inside == (samples_[index(end)] > 0)) return;
    auto u = static_cast<size_t>((axis + 1) % 3), v = static_cast<size_t>((axis + 2) % 3);
    if (!inside) std::swap(u, v);
    std::array<uint32_t, 4>& corners = net_.quads.emplace_back();
    for (size_t c = 0; c < 4; ++c) {
      Place cell = p;
      cell[u] -= c & 1 ? 0 : 1;
      cell[v] -= c & 2 ? 0 : 1;
      corners[c] = static_cast<uint32_t>(vertex_of_[index(cell)]);
    }
  }

  const BlobbyField& field_;
  std::vector<std::vector<float>> leaf_values_; ///< of each variable that interpolates, leaf by leaf
  std::vector<bool> places_;                    ///< mpoints among the variables
  std::vector<double> shares_;                  ///< of the leaves in a point; they add up to 1
  double cell_ = 1;
  Vec3d origin_{0.0};
  std::array<size_t, 3> n_{};
  std::vector<float> samples_;
  std::vector<int> vertex_of_;
  Net net_;
};

} // namespace

void add_blobby(const BlobbyField& field, float wanted, std::span<const TypedParam> vars,
                const std::shared_ptr<const PrimitiveState>& state, PrimitiveList& out) {
  if (field.bound().empty()) return; // constants only: no surface anywhere
  out.add(state, pieces_of(std::make_shared<BlobbyMesh>(NetMaker(field, wanted, vars).run(), vars)));
}

} // namespace render
