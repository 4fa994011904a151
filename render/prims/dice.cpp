// Dicing: lattice positions, tangents, normals, texture coordinates, colours and primitive variables.
#include "render/prims/dice.h"

#include <algorithm>
#include <array>
#include <utility>

namespace render {

namespace {

using slvm::Global;

struct Triple {
  float *x, *y, *z;
  void set(size_t k, Vec3 p) const {
    x[k] = p.x;
    y[k] = p.y;
    z[k] = p.z;
  }
  Vec3 get(size_t k) const { return {x[k], y[k], z[k]}; }
};

/// A variable of which all points that count are stored to.
Triple triple(slvm::Grid& grid, Global g) {
  float* x = grid.to_fill(g);
  return {x, x + grid.pitch(), x + 2 * grid.pitch()};
}

Vec3 read(const slvm::Planes& p, size_t k) {
  return {p.get(0, k), p.get(1, k), p.get(2, k)};
}

Matrix4 scaled(Matrix4 m, float by) {
  for (float& x : m.m)
    x *= by;
  return m;
}

/// What is done to each component of triples alike: sums of the three by weights.
struct LinearMap {
  float weight[3][3];
  Vec3 origin{0.0f};

  Vec3 operator()(const Vec3& v) const {
    auto sum = [&](int c) {
      return v.x * weight[c][0] + v.y * weight[c][1] + v.z * weight[c][2] + origin[c];
    };
    return {sum(0), sum(1), sum(2)};
  }
};

LinearMap of_vectors(const Matrix4& m) {
  LinearMap out;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i)
      out.weight[c][i] = m(i, c);
  return out;
}

LinearMap of_points(const Matrix4& affine) {
  LinearMap out = of_vectors(affine);
  out.origin = {affine(3, 0), affine(3, 1), affine(3, 2)};
  return out;
}

/// Normals go by the inverse transpose.
LinearMap of_normals(const Matrix4& inverse) {
  LinearMap out = of_vectors(inverse);
  for (auto [c, i] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
    std::swap(out.weight[c][i], out.weight[i][c]);
  return out;
}

/// `count` triples from `first` on.
void map_all(const LinearMap& map, const Vec3Planes& from, size_t first, size_t count, Triple to) {
  const float *x = from.plane(0) + first, *y = from.plane(1) + first, *z = from.plane(2) + first;
  float* out[3] = {to.x + first, to.y + first, to.z + first};
  for (int c = 0; c < 3; ++c) {
    const float a = map.weight[c][0], b = map.weight[c][1], d = map.weight[c][2], origin = map.origin[c];
    float* __restrict own = out[c];
    for (size_t k = 0; k < count; ++k)
      own[k] = x[k] * a + y[k] * b + z[k] * d + origin;
  }
}

void transform_points(const Matrix4& m, const Vec3Planes& from, size_t first, size_t count, Triple to) {
  if (is_affine(m)) return map_all(of_points(m), from, first, count, to);
  for (size_t k = first; k < first + count; ++k)
    to.set(k, transform_point(m, from[k]));
}

std::vector<float> parameters(float from, float to, int n) {
  std::vector<float> out(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i)
    out[static_cast<size_t>(i)] = from + (to - from) * (static_cast<float>(i) / static_cast<float>(n - 1));
  out.back() = to; // exactly the neighbour's first value
  return out;
}

/// All but geometry.
class Dicer {
public:
  Dicer(std::span<const SurfacePoints> parts, const DiceContext& context, const ReadVariables& read,
        slvm::Grid& grid)
      : parts_(parts), first_(*parts.front().primitive), attributes_(first_.attributes()), context_(context),
        read_(read), grid_(grid) {}

  void run() {
    grid_.object_to_current = first_.state->object_to_camera;
    grid_.user = &first_;
    set_uniforms();
    if (read_.has(Global::ku) || read_.has(Global::kv) || read_.has(Global::ks) || read_.has(Global::kt))
      set_parameters();
    set_colours();
    for (size_t i = 0; i < first_.vars.size(); ++i)
      set_primvar(i);
  }

private:
  void set_uniforms();
  void set_parameters();
  void set_colours();
  void set_primvar(size_t index);
  void set_st(size_t index);
  template <class F> void each_part(size_t index, bool beside, F&& f) const;
  void fill(size_t index, bool beside, float* planes);
  void to_camera(const PrimitiveState& state, slvm::Type type, float* planes, size_t count,
                 size_t points) const;

  std::span<const SurfacePoints> parts_;
  const Primitive& first_;
  const Attributes& attributes_;
  const DiceContext& context_;
  const ReadVariables& read_;
  slvm::Grid& grid_;
};

void Dicer::set_uniforms() {
  auto set = [&](Global g, std::initializer_list<float> value) {
    grid_.set_uniform(g, {value.begin(), value.size()});
  };
  set(Global::kE, {0, 0, 0});
  set(Global::kncomps, {3});
  set(Global::ktime, {context_.time});
  set(Global::kdtime, {context_.dtime});
  set(Global::kdPdtime, {0, 0, 0});
}

void Dicer::set_parameters() {
  float* __restrict u = grid_.to_fill(Global::ku);
  float* __restrict v = grid_.to_fill(Global::kv);
  float* __restrict s = grid_.to_fill(Global::ks);
  float* __restrict t = grid_.to_fill(Global::kt);
  const auto& tc = attributes_.texture_coordinates;
  for (const SurfacePoints& part : parts_) {
    const UvRect& whole = part.primitive->uv;
    part.at.for_each([&](size_t i, float ui, float vj) {
      u[part.first + i] = whole.u0 + (whole.u1 - whole.u0) * ui;
      v[part.first + i] = whole.v0 + (whole.v1 - whole.v0) * vj;
    });
  }
  // Pieces of odd shapes bring their parameters along; s and t follow these.
  for (size_t i = 0; i < first_.vars.size(); ++i)
    if (Global g = replaced_variable(first_.vars[i]); g == Global::ku || g == Global::kv)
      fill(i, true, g == Global::ku ? u : v);
  for (size_t k = 0; k < grid_.points(); ++k) {
    float a = u[k], b = v[k];
    s[k] = (tc[0] * (1 - a) + tc[2] * a) * (1 - b) + (tc[4] * (1 - a) + tc[6] * a) * b;
    t[k] = (tc[1] * (1 - a) + tc[3] * a) * (1 - b) + (tc[5] * (1 - a) + tc[7] * a) * b;
  }
}

void Dicer::set_colours() {
  for (auto [global, member] :
       {std::pair(Global::kCs, &Attributes::color), std::pair(Global::kOs, &Attributes::opacity)}) {
    auto of = [&, colour = member](const SurfacePoints& part) {
      return part.primitive->attributes().*colour;
    };
    const Color first = of(parts_.front());
    if (std::all_of(parts_.begin(), parts_.end(), [&](const SurfacePoints& p) { return of(p) == first; })) {
      grid_.set_uniform(global, std::array{first.x, first.y, first.z});
      continue;
    }
    Triple to = triple(grid_, global);
    for (const SurfacePoints& part : parts_)
      for (size_t k = part.first; k < part.first + part.at.size(); ++k)
        to.set(k, of(part));
  }
}

/// Object-space values to camera space, in place.
void Dicer::to_camera(const PrimitiveState& state, slvm::Type type, float* planes, size_t count,
                      size_t points) const {
  if (!slvm::is_geometric(type)) return;
  const Matrix4 m = state.object_to_camera;
  const size_t pitch = grid_.pitch();
  auto each = [&](float* x, auto&& transform) {
    const Triple triple{x, x + pitch, x + 2 * pitch};
    for (size_t k = 0; k < points; ++k)
      triple.set(k, transform(triple.get(k)));
  };
  for (size_t e = 0; e < count; ++e, planes += 3 * pitch) {
    if (type == slvm::Type::kPoint)
      each(planes, [&](Vec3 p) { return transform_point(m, p); });
    else if (type == slvm::Type::kVector)
      each(planes, [&](Vec3 v) { return transform_vector(m, v); });
    else
      each(planes, of_normals(state.camera_to_object));
  }
}

/// Calls f(variable, part) for all parts: variables are made once for parts of the same primitive.
/// Not for neighbours of hits that are not `beside`.
template <class F> void Dicer::each_part(size_t index, bool beside, F&& f) const {
  const Primitive* of = nullptr;
  PatchVar var;
  for (const SurfacePoints& part : parts_) {
    if (part.beside && !beside) continue;
    if (part.primitive != of) var = (of = part.primitive)->vars[index];
    f(static_cast<const PatchVar&>(var), part);
  }
}

/// The values of a variable at all points.
void Dicer::fill(size_t index, bool beside, float* planes) {
  each_part(index, beside, [&](const PatchVar& var, const SurfacePoints& part) {
    interpolate(var, part.at, planes + part.first, grid_.pitch());
    to_camera(*part.primitive->state, var.type, planes + part.first, var.elements ? var.elements : 1,
              part.at.size());
  });
}

void Dicer::set_st(size_t index) {
  float* planes[2] = {grid_.to_fill(Global::ks), grid_.to_fill(Global::kt)};
  std::vector<float> both;
  each_part(index, true, [&](const PatchVar& var, const SurfacePoints& part) {
    size_t points = part.at.size();
    both.resize(2 * points);
    interpolate(var, part.at, both.data(), points);
    for (size_t c = 0; c < 2; ++c)
      std::copy_n(both.data() + c * points, points, planes[c] + part.first);
  });
}

void Dicer::set_primvar(size_t index) {
  const PatchVar& var = first_.vars[index];
  if (is_st(var)) return read_.has(Global::ks) || read_.has(Global::kt) ? set_st(index) : void();
  if (Global g = replaced_variable(var); g != Global::kCount)
    return read_.has(g) ? fill(index, read_.has_beside(g), grid_.to_fill(g)) : void();
  if (read_.of_primitives && !read_.of_primitives(var.name)) return;
  // Constant values cost nothing as uniforms; geometric ones and matrices need the transformation below.
  bool plain = var.type == slvm::Type::kFloat || var.type == slvm::Type::kColor ||
               var.type == slvm::Type::kString || var.type == slvm::Type::kMatrix;
  if (var.interpolation == Interpolation::kConstant && plain) {
    slvm::Value value{var.type, var.elements, var.values, var.strings};
    grid_.add_uniform_primvar(var.name, value, *context_.strings);
    return;
  }
  if (var.type == slvm::Type::kString) return; // strings do not interpolate; the interpreter has said so
  const bool beside = !read_.of_primitives_beside || read_.of_primitives_beside(var.name);
  fill(index, beside, grid_.add_varying_primvar(var.name, var.type, var.elements));
}

/// du or dv, from the part of the shaders' u and v that each piece is: varying only where pieces differ.
template <class Step>
void set_steps(slvm::Grid& grid, Global g, std::span<const SurfacePoints> parts, Step&& step) {
  auto of = [&](const SurfacePoints& part) { return step(part.primitive->uv); };
  const float first = of(parts.front());
  grid.set_uniform(g, {&first, 1});
  if (std::all_of(parts.begin(), parts.end(), [&](const SurfacePoints& p) { return of(p) == first; })) return;
  float* steps = grid.varying(g);
  for (const SurfacePoints& part : parts)
    std::fill_n(steps + part.first, part.at.size(), of(part));
}

/// The parameters of a lattice.
struct Lines {
  std::vector<float> u, v;
  explicit Lines(const GridTask& task)
      : u(parameters(task.rect.u0, task.rect.u1, task.nu)),
        v(parameters(task.rect.v0, task.rect.v1, task.nv)) {}
  float du() const { return (u.back() - u.front()) / static_cast<float>(u.size() - 1); }
  float dv() const { return (v.back() - v.front()) / static_cast<float>(v.size() - 1); }
};

/// An empty grid for the whole lattices of pieces.
void begin_lattice(size_t pieces, const GridTask& task, slvm::Grid& grid) {
  grid.reset(task.nu, task.nv * static_cast<int>(pieces));
  if (pieces == 1) return;
  grid.lattice = slvm::Lattice::kPieces;
  grid.piece_rows = task.nv;
}

/// What geometry gives at all parts, one after the other.
void evaluate(std::span<const SurfacePoints> parts, SurfaceLattice& out) {
  if (parts.size() == 1) return parts[0].primitive->geometry->evaluate(parts[0].at, out);
  SurfaceLattice piece;
  for (const SurfacePoints& part : parts) {
    part.primitive->geometry->evaluate(part.at, piece);
    out.append(piece);
  }
}

/// A grid that has its size, with all there is.
void dice_parts(std::span<const SurfacePoints> parts, const Lines& lines, uint64_t id,
                const DiceContext& context, const ReadVariables& read, slvm::Grid& grid) {
  grid.derivatives = true;
  grid.id = id;
  SurfaceLattice lattice;
  evaluate(parts, lattice);
  dice_geometry(parts, lattice, read, grid);
  if (read.has(Global::kI)) {
    Triple P = triple(grid, Global::kP), I = triple(grid, Global::kI);
    for (size_t k = 0; k < grid.points(); ++k)
      I.set(k, context.camera->incident(P.get(k)));
  }
  dice_variables(parts, context, read, grid);
  set_steps(grid, Global::kdu, parts,
            [&](const UvRect& whole) { return (whole.u1 - whole.u0) * lines.du(); });
  set_steps(grid, Global::kdv, parts,
            [&](const UvRect& whole) { return (whole.v1 - whole.v0) * lines.dv(); });
}

} // namespace

slvm::Global replaced_variable(const PatchVar& var) {
  constexpr std::pair<std::string_view, Global> kNames[] = {
      {"Cs", Global::kCs}, {"Os", Global::kOs}, {"s", Global::ks}, {"t", Global::kt},
      {"N", Global::kN},   {"u", Global::ku},   {"v", Global::kv}};
  for (auto [name, global] : kNames)
    if (var.name == name && var.type == slvm::global_info(global).type && !var.elements) return global;
  return Global::kCount;
}

bool is_st(const PatchVar& var) {
  return var.name == "st" && var.elements == 2 && var.type == slvm::Type::kFloat;
}

void dice(std::span<const Primitive> pieces, const GridTask& task, uint64_t id, const DiceContext& context,
          const ReadVariables& read, slvm::Grid& grid) {
  begin_lattice(pieces.size(), task, grid);
  const Lines lines(task);
  const UvPoints at{lines.u, lines.v};
  std::vector<SurfacePoints> parts;
  for (const Primitive& piece : pieces)
    parts.push_back({&piece, at, parts.size() * at.size()});
  dice_parts(parts, lines, id, context, read, grid);
}

void dice_positions(std::span<const Primitive> pieces, const GridTask& task, slvm::Grid& grid) {
  begin_lattice(pieces.size(), task, grid);
  const PrimitiveState& state = *pieces.front().state;
  grid.flip_normals = state.attributes->flips_normals(state.mirrored);
  const Lines lines(task);
  const UvPoints at{lines.u, lines.v};
  Triple P = triple(grid, Global::kP);
  SurfaceLattice piece;
  for (const Primitive& p : pieces) {
    p.geometry->find_points(at, piece);
    transform_points(p.state->object_to_camera, piece.P, 0, at.size(), P);
    P = {P.x + at.size(), P.y + at.size(), P.z + at.size()};
  }
}

void dice_some(std::span<const Primitive> pieces, const GridTask& task, std::span<const uint32_t> points,
               bool beside, uint64_t id, const DiceContext& context, const ReadVariables& read,
               slvm::Grid& grid) {
  const Lines lines(task);
  const size_t nu = lines.u.size(), of_piece = nu * lines.v.size(), count = points.size();
  const size_t rows = beside ? 3 : 1, steps[] = {0, 1, nu}; // from a point to those of its rows
  grid.reset(static_cast<int>(count), static_cast<int>(rows));
  grid.lattice = slvm::Lattice::kHits;
  std::vector<float> u, v;
  u.reserve(rows * count);
  v.reserve(rows * count);
  std::vector<SurfacePoints> parts;
  for (size_t row = 0; row < rows; ++row)
    for (size_t first = 0, end = 0; first < count; first = end) {
      const size_t piece = points[first] / of_piece, from = u.size();
      for (; end < count && points[end] / of_piece == piece; ++end) {
        const size_t at = points[end] % of_piece + steps[row];
        u.push_back(lines.u[at % nu]);
        v.push_back(lines.v[at / nu]);
      }
      parts.push_back(
          {&pieces[piece], {{&u[from], end - first}, {&v[from], end - first}, true}, from, row > 0});
    }
  dice_parts(parts, lines, id, context, read, grid);
}

void dice_geometry(std::span<const SurfacePoints> parts, const SurfaceLattice& lattice,
                   const ReadVariables& read, slvm::Grid& grid) {
  const Primitive& alike = *parts.front().primitive;
  grid.flip_normals = alike.attributes().flips_normals(alike.state->mirrored);
  Triple P = triple(grid, Global::kP), N = triple(grid, Global::kN);
  for (const SurfacePoints& part : parts) {
    const Primitive& primitive = *part.primitive;
    const Matrix4 m = primitive.state->object_to_camera, inverse = primitive.state->camera_to_object;
    const size_t first = part.first, count = part.at.size();
    transform_points(m, lattice.P, first, count, P);
    auto tangent = [&](Global g, const Vec3Planes& from, float width) {
      if (!read.has(g)) return;
      const Matrix4 by = scaled(m, 1 / width);
      map_all(of_vectors(by), from, first, count, triple(grid, g));
    };
    tangent(Global::kdPdu, lattice.dPdu, primitive.uv.u1 - primitive.uv.u0);
    tangent(Global::kdPdv, lattice.dPdv, primitive.uv.v1 - primitive.uv.v0);
    // N is the transformed object-space normal, which points to the object's outside whatever the handedness;
    // what the orientation asks for is the side that dPdu x dPdv in camera space, flipped or not, is on.
    const Matrix4 n = scaled(inverse, grid.flip_normals == primitive.state->mirrored ? 1.0f : -1.0f);
    map_all(of_normals(n), lattice.N, first, count, N);
    if (!read.has(Global::kNg)) continue;
    const Triple Ng = triple(grid, Global::kNg);
    std::copy_n(N.x + first, count, Ng.x + first);
    std::copy_n(N.y + first, count, Ng.y + first);
    std::copy_n(N.z + first, count, Ng.z + first);
  }
}

void dice_variables(std::span<const SurfacePoints> parts, const DiceContext& context,
                    const ReadVariables& read, slvm::Grid& grid) {
  Dicer(parts, context, read, grid).run();
}

void renew_geometry(const Camera& camera, slvm::Grid& grid) {
  Triple P = triple(grid, Global::kP), Ng = triple(grid, Global::kNg), dPdu = triple(grid, Global::kdPdu),
         dPdv = triple(grid, Global::kdPdv), I = triple(grid, Global::kI);
  const slvm::Planes &du = grid.variable(Global::kdu), &dv = grid.variable(Global::kdv);
  auto nu = static_cast<size_t>(grid.nu()), nv = static_cast<size_t>(grid.nv()),
       rows = static_cast<size_t>(grid.rows_of_piece());
  float sign = grid.flip_normals ? -1.0f : 1.0f;
  for (size_t j = 0; j < nv; ++j)
    for (size_t i = 0; i < nu; ++i) {
      size_t k = j * nu + i;
      // Central differences inside, one-sided ones at the edges.
      size_t i0 = i > 0 ? i - 1 : i, i1 = i + 1 < nu ? i + 1 : i;
      size_t j0 = j % rows > 0 ? j - 1 : j, j1 = j % rows + 1 < rows ? j + 1 : j;
      Vec3 along_u = (P.get(j * nu + i1) - P.get(j * nu + i0)) / (static_cast<float>(i1 - i0) * du.get(0, k));
      Vec3 along_v = (P.get(j1 * nu + i) - P.get(j0 * nu + i)) / (static_cast<float>(j1 - j0) * dv.get(0, k));
      dPdu.set(k, along_u);
      dPdv.set(k, along_v);
      Vec3 n = glm::cross(along_u, along_v) * sign;
      if (glm::dot(n, n) > 0) Ng.set(k, n); // else, at a pole, the undisplaced one is as good
      I.set(k, camera.incident(P.get(k)));
    }
}

void set_motion(slvm::Grid& grid, const slvm::Grid& at_close, float duration) {
  const slvm::Planes &from = grid.variable(Global::kP), &to = at_close.variable(Global::kP);
  Triple motion = triple(grid, Global::kdPdtime);
  for (size_t k = 0; k < grid.points(); ++k)
    motion.set(k, duration > 0 ? (read(to, k) - read(from, k)) / duration : Vec3(0.0f));
}

bool faces_away(const slvm::Grid& grid, const Camera& camera) {
  const slvm::Planes &P = grid.variable(Global::kP), &Ng = grid.variable(Global::kNg);
  for (size_t k = 0; k < grid.points(); ++k)
    if (glm::dot(read(Ng, k), camera.incident(read(P, k))) <= 0) return false;
  return true;
}

} // namespace render
