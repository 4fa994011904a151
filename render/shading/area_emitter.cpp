// Measuring surfaces of area lights, and finding points on them.
#include "render/shading/area_emitter.h"

#include "slvm/format/program.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace render {

namespace {

using slvm::Global;

/// Cells of all lattices together, about; of one lattice a side, at most, and at least where it is curved.
/// In a plane bilinear patch the area is linear: one cell is exact.
constexpr size_t kCells = size_t{1} << 16;
constexpr int kMostCells = 32, kCurvedCells = 4, kRuledCells = 4;

/// So many entries of the guide for each row: seldom does a row end within one.
constexpr size_t kGuides = 8;

/// What shaders read of a surface, but for P and N, which are always there.
constexpr Global kOfSurface[] = {Global::kP,    Global::kN,  Global::kNg, Global::kdPdu,
                                 Global::kdPdv, Global::ku,  Global::kv,  Global::ks,
                                 Global::kt,    Global::kCs, Global::kOs};

std::vector<float> even(int cells) {
  std::vector<float> out(static_cast<size_t>(cells) + 1);
  for (size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<float>(i) / static_cast<float>(cells);
  return out;
}

/// Where the integral of a density that goes from `a` to `b` reaches `part` of the whole.
float linear_place(float a, float b, float part) {
  // About equal, as on most surfaces in one of two directions: the middle is off by an eighth of this.
  if (std::abs(b - a) <= 1e-4f * (a + b)) return part;
  const float wanted = part * (a + b) / 2;
  const float root = std::sqrt(std::max(a * a + 2 * (b - a) * wanted, 0.0f));
  return a + root > 0 ? std::min(2 * wanted / (a + root), 1.0f) : part;
}

bool same_group(const Primitive& a, const Primitive& b) {
  const VarSource* vars = a.vars.source();
  return a.state == b.state && vars == b.vars.source() && (!vars || !vars->differs_by_piece());
}

/// Of all that surfaces have, what this shader reads.
ReadVariables read_by(const slvm::Program& reader, std::span<const std::string> shared) {
  ReadVariables read;
  read.predefined.reset();
  for (const slvm::Slot& slot : reader.slots)
    if (Global g = slot.parameter ? Global::kCount : slvm::find_global(slot.name); g != Global::kCount)
      read.predefined.set(static_cast<size_t>(g));
  for (Global g : {Global::ks, Global::kt}) // texture() reads them unasked
    if (!reader.imports.empty()) read.predefined.set(static_cast<size_t>(g));
  read.of_primitives = [&reader, shared](const std::string& name) {
    return std::binary_search(shared.begin(), shared.end(), name) &&
           std::any_of(reader.params.begin(), reader.params.end(),
                       [&](const slvm::Param& p) { return p.name == name; });
  };
  return read;
}

} // namespace

AreaEmitter::AreaEmitter(PrimitiveList surface, uint32_t samples, const DiceContext& context)
    : surface_(std::move(surface)), samples_(samples), context_(context) {
  for (Primitive p : surface_)
    primitives_.push_back(std::move(p));
  sort_primitives();
  lattices_.resize(primitives_.size());
  double area = 0;
  for (size_t p = 0; p < primitives_.size(); ++p) {
    Lattice& lattice = lattices_[p];
    measure(primitives_[p], lattice);
    for (int j = 0; j < lattice.nv; ++j) {
      const float sides =
          lattice.integral[lattice.at(lattice.nu, j)] + lattice.integral[lattice.at(lattice.nu, j + 1)];
      if (!(sides > 0) || !std::isfinite(sides)) continue;
      rows_.push_back({static_cast<uint32_t>(p), j, 1 / static_cast<float>(lattice.nu),
                       1 / static_cast<float>(lattice.nv)});
      row_ends_.push_back(area += static_cast<double>(sides) / 2 / lattice.nv);
    }
  }
  const size_t parts = kGuides * row_ends_.size();
  for (size_t k = 0, r = 0; k < parts; ++k) {
    while (row_ends_[r] <= area * static_cast<double>(k) / static_cast<double>(parts))
      ++r;
    guide_.push_back(static_cast<uint32_t>(r));
  }
  find_shared_variables();
}

/// Into groups, in the order in which their first ones come.
void AreaEmitter::sort_primitives() {
  struct Key {
    const void *state, *vars;
    size_t alone; ///< apart where only it has its variables
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, uint32_t> numbers;
  std::vector<std::pair<uint32_t, Primitive>> sorted;
  for (Primitive& p : primitives_) {
    const bool shares = same_group(p, p);
    const Key key{p.state.get(), p.vars.source(), shares ? 0 : sorted.size() + 1};
    const uint32_t group = numbers.try_emplace(key, static_cast<uint32_t>(numbers.size())).first->second;
    sorted.emplace_back(group, std::move(p));
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  primitives_.clear();
  for (auto& [group, primitive] : sorted) {
    group_.push_back(group);
    primitives_.push_back(std::move(primitive));
  }
}

void AreaEmitter::measure(const Primitive& p, Lattice& lattice) const {
  const auto side =
      static_cast<int>(std::sqrt(static_cast<double>(kCells) / static_cast<double>(primitives_.size())));
  const bool ruled = p.geometry->ruled();
  lattice.nu = lattice.nv = std::clamp(side, ruled ? 1 : kCurvedCells, ruled ? kRuledCells : kMostCells);
  const std::vector<float> u = even(lattice.nu), v = even(lattice.nv);
  SurfaceLattice points;
  p.geometry->evaluate({u, v}, points);
  lattice.area.resize(points.P.size());
  lattice.integral.resize(points.P.size());
  const Matrix4& m = p.state->object_to_camera;
  for (size_t k = 0; k < lattice.area.size(); ++k)
    lattice.area[k] =
        glm::length(glm::cross(transform_vector(m, points.dPdu[k]), transform_vector(m, points.dPdv[k])));
  for (int j = 0; j <= lattice.nv; ++j) {
    double sum = 0;
    for (int i = 1; i <= lattice.nu; ++i) {
      sum += static_cast<double>(lattice.area[lattice.at(i - 1, j)] + lattice.area[lattice.at(i, j)]) / 2 /
             lattice.nu;
      lattice.integral[lattice.at(i, j)] = static_cast<float>(sum);
    }
  }
}

void AreaEmitter::find_shared_variables() {
  std::map<std::string, size_t> count;
  size_t groups = 0;
  for (size_t p = 0; p < primitives_.size(); ++p) {
    if (p > 0 && group_[p] == group_[p - 1]) continue;
    ++groups;
    for (const PatchVar& v : primitives_[p].vars)
      ++count[v.name];
  }
  for (const auto& [name, times] : count)
    if (times == groups) shared_.push_back(name); // sorted, as in the map
}

AreaEmitter::Spot AreaEmitter::spot(float x, float y) const {
  const double wanted = static_cast<double>(x) * row_ends_.back();
  const size_t rows = row_ends_.size();
  size_t r = guide_[std::min(static_cast<size_t>(x * static_cast<float>(guide_.size())), guide_.size() - 1)];
  while (r + 1 < rows && row_ends_[r] <= wanted)
    ++r;
  while (r > 0 && row_ends_[r - 1] > wanted) // by rounding
    --r;
  const double begin = r ? row_ends_[r - 1] : 0;
  const Lattice& lattice = lattices_[rows_[r].primitive];
  const int j = rows_[r].row;
  const float *low = &lattice.integral[lattice.at(0, j)], *high = &lattice.integral[lattice.at(0, j + 1)];
  const float in_row = static_cast<float>((wanted - begin) / (row_ends_[r] - begin));
  const float weight = linear_place(low[lattice.nu], high[lattice.nu], std::clamp(in_row, 0.0f, 1.0f));
  auto between = [weight](float a, float b) { return a + (b - a) * weight; };
  const float target = y * between(low[lattice.nu], high[lattice.nu]);
  // Cells of a row are about equal, on most surfaces.
  int i = std::min(static_cast<int>(y * static_cast<float>(lattice.nu)), lattice.nu - 1);
  while (i + 1 < lattice.nu && between(low[i + 1], high[i + 1]) <= target)
    ++i;
  while (i > 0 && between(low[i], high[i]) > target)
    --i;
  const float from = between(low[i], high[i]), to = between(low[i + 1], high[i + 1]);
  const float in_cell = to > from ? std::clamp((target - from) / (to - from), 0.0f, 1.0f) : 0.5f;
  const float *a = &lattice.area[lattice.at(i, j)], *b = &lattice.area[lattice.at(i, j + 1)];
  const float along = linear_place(between(a[0], b[0]), between(a[1], b[1]), in_cell);
  return {rows_[r].primitive, 0, (static_cast<float>(i) + along) * rows_[r].du,
          (static_cast<float>(j) + weight) * rows_[r].dv};
}

/// A grid of points of primitives that can be diced together, those of one side by side.
void AreaEmitter::fill(std::span<const Spot> spots, const ReadVariables& read, slvm::Grid& part) const {
  std::vector<float> u, v;
  for (const Spot& s : spots) {
    u.push_back(s.u);
    v.push_back(s.v);
  }
  std::vector<SurfacePoints> parts;
  SurfaceLattice lattice, scratch;
  for (size_t first = 0, end = 0; first < spots.size(); first = end) {
    while (end < spots.size() && spots[end].primitive == spots[first].primitive)
      ++end;
    const UvPoints at{std::span(u).subspan(first, end - first), std::span(v).subspan(first, end - first),
                      true};
    const Primitive& primitive = primitives_[spots[first].primitive];
    if (at.u.size() == spots.size()) {
      primitive.geometry->evaluate(at, lattice);
    } else {
      primitive.geometry->evaluate(at, scratch);
      lattice.append(scratch);
    }
    parts.push_back({&primitive, at, first});
  }
  part.reset(static_cast<int>(spots.size()), 1);
  part.derivatives = false;
  dice_geometry(parts, lattice, read, part);
  dice_variables(parts, context_, read, part);
}

namespace {

/// Point k of the one to the point of the other that `spots` says; step 0 has the same for all.
template <class Spots> void scatter(const slvm::Planes& from, const Spots& spots, float* to, size_t pitch) {
  const size_t planes = static_cast<size_t>(slvm::components(from.type)) * std::max(from.elements, 1u);
  const auto &first = spots.front(), &last = spots.back();
  // Those of one primitive ascend.
  const bool run = first.primitive == last.primitive && last.point - first.point + 1 == spots.size();
  for (size_t c = 0; c < planes; ++c) {
    const float* values = from.data + c * from.pitch;
    float* out = to + c * pitch;
    if (run && from.step)
      std::copy_n(values, spots.size(), out + first.point);
    else
      for (size_t k = 0; k < spots.size(); ++k)
        out[spots[k].point] = values[from.step ? k : 0];
  }
}

} // namespace

void AreaEmitter::place(std::span<const float> x, std::span<const float> y, const slvm::Program& reader,
                        slvm::Grid& grid) const {
  std::vector<Spot> spots;
  spots.reserve(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    spots.push_back(spot(x[i], y[i]));
    spots.back().point = static_cast<uint32_t>(i);
  }
  if (primitives_.size() > 1)
    std::sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) {
      return std::tie(a.primitive, a.point) < std::tie(b.primitive, b.point);
    });
  const ReadVariables read = read_by(reader, shared_);
  slvm::Grid part(1, 1);
  for (size_t first = 0, end = 0; first < spots.size(); first = end) {
    while (end < spots.size() && group_[spots[end].primitive] == group_[spots[first].primitive])
      ++end;
    const std::span<const Spot> alike = std::span(spots).subspan(first, end - first);
    fill(alike, read, part);
    for (Global g : kOfSurface)
      if (const slvm::Planes& from = part.variable(g);
          from.data && (read.has(g) || g == Global::kP || g == Global::kN))
        scatter(from, alike, grid.varying(g), grid.pitch());
    for (const auto& [name, from] : part.primvars()) {
      const slvm::Planes* known = grid.primvar(name);
      if (known && (known->type != from.type || known->elements != from.elements)) continue;
      float* to = known ? known->data : grid.add_varying_primvar(name, from.type, from.elements);
      scatter(from, alike, to, grid.pitch());
    }
  }
  const float step = 1 / std::sqrt(static_cast<float>(samples_));
  for (Global g : {Global::kdu, Global::kdv})
    grid.set_uniform(g, {&step, 1});
}

} // namespace render
