// The four polygon requests: one or many faces, with or without holes. All become the same list of faces.
#include "render/prims/polygons.h"
#include "render/state/interpreter.h"
#include "render/state/left_out.h"

#include <fmt/format.h>

#include <numeric>

namespace render {

/// Polygon and GeneralPolygon: the vertices are those of P, in order.
void Interpreter::polygon(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  size_t n = sizes->vertex;
  std::vector<int> loops{static_cast<int>(n)};
  if (call.id == RequestId::kGeneralPolygon) loops.assign(call.integers(0).begin(), call.integers(0).end());
  std::vector<TypedParam> vars = primitive_vars(call, *sizes);
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  if (n < 3) {
    error(call, fmt::format("a polygon has at least 3 vertices, found {}", n));
    return;
  }
  PolygonFaces face;
  face.vertices.resize(n);
  std::iota(face.vertices.begin(), face.vertices.end(), 0);
  face.loops_of_face = {static_cast<int>(loops.size())};
  face.loops = std::move(loops);
  face.one_of_several = in_motion_.has_value();
  scene_.primitives.add(primitive_state(), make_polygons(std::move(face), std::move(P), std::move(vars)));
}

void Interpreter::add_mesh(const RequestCall& call,
                           const std::function<std::shared_ptr<const Pieces>()>& make) {
  std::shared_ptr<const Pieces> pieces;
  if (auto digest = digest_of(call, declarations_)) {
    if (in_motion_) (*digest)[0] ^= 1; // PolygonFaces::one_of_several
    std::weak_ptr<const Pieces>& known = meshes_[*digest];
    pieces = known.lock();
    if (!pieces) known = pieces = make();
  } else {
    pieces = make();
  }
  if (!pieces) return;
  if (scene_.primitives.size() + pieces->count() > most_primitives)
    error(call, fmt::format("more than {} surfaces in a world; the mesh is skipped", most_primitives),
          RiError::kLimit);
  else
    scene_.primitives.add(primitive_state(), std::move(pieces));
}

/// PointsPolygons and PointsGeneralPolygons.
void Interpreter::points_polygons(const RequestCall& call) {
  auto sizes = sizes_of(call);
  if (!sizes) return;
  bool general = call.id == RequestId::kPointsGeneralPolygons;
  int first_argument = general ? 1 : 0;
  std::span<const int> loops = call.integers(first_argument);
  std::vector<int> loops_of_face(loops.size(), 1);
  if (general) loops_of_face.assign(call.integers(0).begin(), call.integers(0).end());
  if (loops.empty()) return; // exporters write empty meshes
  add_mesh(call, [&]() -> std::shared_ptr<const Pieces> {
    std::vector<TypedParam> vars = primitive_vars(call, *sizes);
    std::vector<Vec3> P;
    if (!take_positions(call, vars, P, false)) return nullptr;
    std::span<const int> vertices = call.integers(first_argument + 1);
    PolygonFaces faces{{vertices.begin(), vertices.end()}, {loops.begin(), loops.end()}, {}};
    if (general) faces.loops_of_face = std::move(loops_of_face);
    faces.one_of_several = in_motion_.has_value();
    say_left_out(call, first_argument, "face", leave_out_bad_faces(faces, P, vars));
    return make_polygons(std::move(faces), std::move(P), std::move(vars));
  });
}

} // namespace render
