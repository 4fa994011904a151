// SubdivisionMesh and its tags.
#include "render/prims/subdivision.h"
#include "render/state/interpreter.h"
#include "render/state/left_out.h"

#include <fmt/format.h>

namespace render {

namespace {

/// One tag with its numbers.
struct Tag {
  std::string_view name;
  std::span<const int> ints;
  std::span<const float> floats;
};

/// A sharpness for each of `count` edges or corners from one for all or one for each. Empty: neither.
std::vector<float> sharpnesses(const Tag& tag, size_t count) {
  if (tag.floats.size() == 1) return std::vector<float>(count, tag.floats[0]);
  return tag.floats.size() == count ? std::vector<float>(tag.floats.begin(), tag.floats.end())
                                    : std::vector<float>{};
}

bool in_range(std::span<const int> indices, size_t count) {
  return std::all_of(indices.begin(), indices.end(),
                     [count](int i) { return i >= 0 && static_cast<size_t>(i) < count; });
}

/// Enters a tag into the mesh. The text of what is wrong with it, or nothing.
std::string apply_tag(const Tag& tag, size_t points, SubdivisionMesh& mesh) {
  int first = tag.ints.empty() ? 1 : tag.ints[0];
  if (tag.name == "hole") {
    if (!in_range(tag.ints, mesh.nvertices.size())) return "a number is not that of a face";
    mesh.holes.insert(mesh.holes.end(), tag.ints.begin(), tag.ints.end());
  } else if (tag.name == "crease") {
    if (tag.ints.size() < 2) return "a crease has at least 2 vertices";
    if (!in_range(tag.ints, points)) return "a number is not that of a vertex";
    std::vector<float> sharp = sharpnesses(tag, tag.ints.size() - 1);
    if (sharp.empty()) return "a crease takes one sharpness, or one for each edge";
    for (size_t i = 0; i < sharp.size(); ++i)
      mesh.crease_pairs.insert(mesh.crease_pairs.end(), {tag.ints[i], tag.ints[i + 1]});
    mesh.crease_sharpness.insert(mesh.crease_sharpness.end(), sharp.begin(), sharp.end());
  } else if (tag.name == "corner") {
    if (!in_range(tag.ints, points)) return "a number is not that of a vertex";
    std::vector<float> sharp = sharpnesses(tag, tag.ints.size());
    if (sharp.size() != tag.ints.size()) return "corners take one sharpness, or one each";
    mesh.corners.insert(mesh.corners.end(), tag.ints.begin(), tag.ints.end());
    mesh.corner_sharpness.insert(mesh.corner_sharpness.end(), sharp.begin(), sharp.end());
  } else if (tag.name == "interpolateboundary") {
    if (first < 0 || first > 2) return "the value is 0, 1 or 2";
    mesh.boundary = first;
  } else if (tag.name == "facevaryinginterpolateboundary") {
    if (first < 0 || first > 3) return "the value is 0, 1, 2 or 3";
    mesh.facevarying_boundary = first;
  } else if (tag.name == "facevaryingpropagatecorners") {
    mesh.propagate_corners = first != 0;
  } else if (tag.name == "smoothtriangles") {
    mesh.smooth_triangles = first != 0;
  } else if (tag.name == "creasemethod") {
    mesh.chaikin = first != 0;
  } else {
    return "this tag is not known and has no effect";
  }
  return {};
}

} // namespace

/// The tags of the request go into `mesh`. False, with a message: their numbers do not add up.
bool Interpreter::subdivision_tags(const RequestCall& call, size_t points, SubdivisionMesh& mesh) {
  if (!call.has(3)) return true;
  auto tags = call.texts(3);
  auto nargs = call.integers(4), ints = call.integers(5);
  auto floats = call.numbers(6);
  if (nargs.size() != 2 * tags.size()) {
    error_at(
        call.arguments[4].where, call,
        fmt::format("'nargs' takes two numbers for each of {} tags, found {}", tags.size(), nargs.size()));
    return false;
  }
  size_t next_int = 0, next_float = 0;
  for (size_t i = 0; i < tags.size(); ++i) {
    auto ni = static_cast<size_t>(std::max(nargs[2 * i], 0)),
         nf = static_cast<size_t>(std::max(nargs[2 * i + 1], 0));
    if (next_int + ni > ints.size() || next_float + nf > floats.size()) {
      error_at(call.arguments[5].where, call,
               fmt::format("there are fewer numbers than 'nargs' says for \"{}\"", tags[i]));
      return false;
    }
    std::string wrong =
        apply_tag({tags[i], ints.subspan(next_int, ni), floats.subspan(next_float, nf)}, points, mesh);
    if (!wrong.empty())
      diagnostics_.warning(
          call.arguments[3].where, "rib",
          fmt::format("{}: tag \"{}\": {}; it is skipped", call.info().name, tags[i], wrong));
    next_int += ni;
    next_float += nf;
  }
  return true;
}

void Interpreter::subdivision_mesh(const RequestCall& call) {
  const std::string& scheme = call.text(0);
  if (scheme != "catmull-clark" && scheme != "bilinear" && scheme != "loop")
    diagnostics_.warning(
        call.arguments[0].where, "rib",
        fmt::format("{}: scheme \"{}\" is not known; read as \"catmull-clark\"", call.info().name, scheme));
  SubdivisionMesh mesh;
  mesh.bilinear = scheme == "bilinear";
  mesh.loop = scheme == "loop";
  mesh.nvertices = call.integers(1);
  mesh.vertices = call.integers(2);
  auto sizes = sizes_of(call);
  if (!sizes || mesh.nvertices.empty()) return; // exporters write empty meshes
  add_mesh(call, [&]() -> std::shared_ptr<const Pieces> {
    std::vector<TypedParam> vars = primitive_vars(call, *sizes);
    std::vector<Vec3> P;
    if (!take_positions(call, vars, P, false) || !subdivision_tags(call, sizes->vertex, mesh)) return nullptr;
    PolygonFaces faces{
        {mesh.vertices.begin(), mesh.vertices.end()}, {mesh.nvertices.begin(), mesh.nvertices.end()}, {}};
    say_left_out(call, 1, "face", leave_out_bad_faces(faces, P, vars, &mesh.holes));
    mesh.nvertices = faces.loops;
    mesh.vertices = faces.vertices;
    if (mesh.nvertices.empty()) return nullptr;
    auto made = make_subdivision(mesh, P, vars);
    if (!made) {
      error(call, made.error());
      return nullptr;
    }
    if ((*made)->count() == 0)
      warn(call, "no face has a surface; a mesh with an open boundary needs the tag \"interpolateboundary\"");
    return *made;
  });
}

} // namespace render
