#include "render/state/fragment.h"

#include "render/state/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace render {

namespace {

// Each face has all others around it that share a vertex: these bounds keep the work in proportion to the
// mesh.
constexpr size_t kMostFacesAtVertex = 256;
constexpr int kMostCorners = 256;

/// A tag of the request with its numbers.
struct Tag {
  std::string name;
  std::span<const int> ints;
  std::span<const float> floats;
};

/// Of a mesh: its faces, and where each vertex belongs.
struct Mesh {
  std::span<const int> nvertices, vertices;
  std::vector<size_t> first; ///< of each face in `vertices`
  std::vector<Vec3> P;
  std::vector<std::vector<int>> faces_at; ///< each vertex
  std::vector<bool> border;               ///< vertices
  std::vector<bool> hole;                 ///< faces
  std::vector<Tag> tags;                  ///< but for creases and corners
  struct Sharp {
    int to; ///< the other end of a crease; of corners the vertex itself
    float sharpness;
  };
  std::vector<std::vector<Sharp>> sharp_at; ///< each vertex; empty: there are none
  bool to_the_border = false;

  std::span<const int> corners(int face) const {
    return vertices.subspan(first[static_cast<size_t>(face)],
                            static_cast<size_t>(nvertices[static_cast<size_t>(face)]));
  }
};

/// Creases and corners, each at its first vertex. Those that are wrong are said so when the mesh is drawn.
void keep_sharp(const Tag& tag, Mesh& mesh) {
  mesh.sharp_at.resize(mesh.P.size());
  const size_t edge = tag.name == "crease" ? 1 : 0;
  for (size_t i = 0; i + edge < tag.ints.size() && !tag.floats.empty(); ++i)
    if (const int from = tag.ints[i]; from >= 0 && static_cast<size_t>(from) < mesh.P.size())
      mesh.sharp_at[static_cast<size_t>(from)].push_back(
          {tag.ints[i + edge], tag.floats[std::min(i, tag.floats.size() - 1)]});
}

std::string read_tags(const RequestCall& call, Mesh& mesh) {
  if (!call.has(3)) return {};
  const auto names = call.texts(3);
  const auto nargs = call.integers(4), ints = call.integers(5);
  const auto floats = call.numbers(6);
  size_t next_int = 0, next_float = 0;
  for (size_t i = 0; i < names.size(); ++i) {
    if (nargs.size() < 2 * i + 2 || nargs[2 * i] < 0 || nargs[2 * i + 1] < 0)
      return fmt::format("the tag \"{}\" has no numbers in 'nargs'", names[i]);
    const auto ni = static_cast<size_t>(nargs[2 * i]), nf = static_cast<size_t>(nargs[2 * i + 1]);
    if (next_int + ni > ints.size() || next_float + nf > floats.size())
      return fmt::format("there are fewer numbers than 'nargs' says for \"{}\"", names[i]);
    const Tag tag{names[i], ints.subspan(next_int, ni), floats.subspan(next_float, nf)};
    next_int += ni;
    next_float += nf;
    if (tag.name == "crease" || tag.name == "corner")
      keep_sharp(tag, mesh);
    else
      mesh.tags.push_back(tag);
    if (tag.name == "interpolateboundary") mesh.to_the_border = tag.ints.empty() || tag.ints[0] != 0;
    for (size_t k = 0; tag.name == "hole" && k < ni; ++k)
      if (const int face = tag.ints[k]; face >= 0 && static_cast<size_t>(face) < mesh.hole.size())
        mesh.hole[static_cast<size_t>(face)] = true;
  }
  return {};
}

/// "" or what is wrong.
std::string read_mesh(const RequestCall& call, Mesh& mesh) {
  mesh.nvertices = call.integers(1);
  mesh.vertices = call.integers(2);
  const Param* P = call.find_param("P");
  if (!P || P->numbers.size() % 3 != 0) return "it needs \"P\", three numbers a point";
  for (size_t i = 0; i + 2 < P->numbers.size(); i += 3)
    mesh.P.emplace_back(P->numbers[i], P->numbers[i + 1], P->numbers[i + 2]);
  size_t corners = 0;
  for (int n : mesh.nvertices) {
    if (n < 3) return fmt::format("a face has at least 3 vertices, found {}", n);
    if (n > kMostCorners) return fmt::format("a face has more than {} vertices", kMostCorners);
    mesh.first.push_back(corners);
    corners += static_cast<size_t>(n);
  }
  if (corners != mesh.vertices.size())
    return fmt::format("'nvertices' asks for {} vertex numbers, found {}", corners, mesh.vertices.size());
  mesh.hole.assign(mesh.nvertices.size(), false);
  mesh.faces_at.resize(mesh.P.size());
  mesh.border.assign(mesh.P.size(), false);
  std::map<std::pair<int, int>, int> edges; // how many faces have each
  for (size_t f = 0; f < mesh.nvertices.size(); ++f) {
    const auto face = mesh.corners(static_cast<int>(f));
    for (size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      if (a < 0 || static_cast<size_t>(a) >= mesh.P.size())
        return fmt::format("there is no vertex {}, \"P\" has {}", a, mesh.P.size());
      mesh.faces_at[static_cast<size_t>(a)].push_back(static_cast<int>(f));
      ++edges[std::minmax(a, b)];
    }
  }
  for (const auto& faces : mesh.faces_at)
    if (faces.size() > kMostFacesAtVertex)
      return fmt::format("more than {} faces meet at a vertex", kMostFacesAtVertex);
  for (const auto& [edge, count] : edges)
    if (count != 2)
      mesh.border[static_cast<size_t>(edge.first)] = mesh.border[static_cast<size_t>(edge.second)] = true;
  return read_tags(call, mesh);
}

/// The plane of a face: two axes in it, along its longest edge and across.
struct Plane {
  Vec3 u{0}, v{0};
  Vec2 least{0}, most{0}; ///< of the face's corners

  Vec2 flat(const Vec3& p) const { return {glm::dot(p, u), glm::dot(p, v)}; }
  Vec2 extent() const { return most - least; }
};

/// Nothing: the face has no extent.
std::optional<Plane> plane_of(const Mesh& mesh, int face) {
  const auto corners = mesh.corners(face);
  auto at = [&](size_t k) { return mesh.P[static_cast<size_t>(corners[k % corners.size()])]; };
  Vec3 normal(0), longest(0);
  for (size_t k = 0; k < corners.size(); ++k) {
    const Vec3 edge = at(k + 1) - at(k);
    normal += glm::cross(at(k) - at(0), at(k + 1) - at(0));
    if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
  }
  if (!(glm::length(normal) > 0)) return {};
  Plane plane;
  normal = glm::normalize(normal);
  const Vec3 in_plane = longest - normal * glm::dot(longest, normal);
  if (!(glm::length(in_plane) > 0)) return {};
  plane.u = glm::normalize(in_plane);
  plane.v = glm::cross(normal, plane.u);
  plane.least = plane.most = plane.flat(at(0));
  for (size_t k = 1; k < corners.size(); ++k) {
    plane.least = glm::min(plane.least, plane.flat(at(k)));
    plane.most = glm::max(plane.most, plane.flat(at(k)));
  }
  return plane;
}

/// A face with those around it; the face first.
struct Patch {
  std::vector<int> faces;
  std::vector<int> vertices;   ///< of the mesh, by the number they have here
  std::map<int, int> renumber; ///< and back
};

Patch patch_of(const Mesh& mesh, int face) {
  Patch patch{{face}, {}, {}};
  std::vector<int> around;
  for (int vertex : mesh.corners(face)) {
    const auto& there = mesh.faces_at[static_cast<size_t>(vertex)];
    around.insert(around.end(), there.begin(), there.end());
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::remove_copy(around.begin(), around.end(), std::back_inserter(patch.faces), face);
  for (int f : patch.faces)
    for (int vertex : mesh.corners(f))
      if (patch.renumber.emplace(vertex, static_cast<int>(patch.vertices.size())).second)
        patch.vertices.push_back(vertex);
  return patch;
}

/// Corner k of a face that turns the other way round.
size_t turned(size_t k, size_t corners) {
  return k == 0 ? 0 : corners - k;
}

/// A variable for the patch. Its values were checked.
Param select(const Param& all, const Declaration& d, const Mesh& mesh, const Patch& patch) {
  Param out = all;
  if (d.storage == StorageClass::kConstant) return out;
  out.numbers.clear();
  out.strings.clear();
  const auto width = static_cast<size_t>(d.width());
  auto take = [&](size_t value) {
    const auto from = static_cast<std::ptrdiff_t>(value * width),
               to = from + static_cast<std::ptrdiff_t>(width);
    if (all.is_string())
      out.strings.insert(out.strings.end(), all.strings.begin() + from, all.strings.begin() + to);
    else
      out.numbers.insert(out.numbers.end(), all.numbers.begin() + from, all.numbers.begin() + to);
  };
  if (d.storage == StorageClass::kVertex || d.storage == StorageClass::kVarying)
    for (int vertex : patch.vertices)
      take(static_cast<size_t>(vertex));
  for (int f : patch.faces) {
    if (d.storage == StorageClass::kUniform) take(static_cast<size_t>(f));
    const size_t corners = mesh.corners(f).size();
    for (size_t k = 0; d.storage == StorageClass::kFaceVarying && k < corners; ++k)
      take(mesh.first[static_cast<size_t>(f)] + turned(k, corners));
  }
  return out;
}

/// The tags of the patch; all faces but the first are holes.
class PatchTags {
public:
  PatchTags(const Mesh& mesh, const Patch& patch) : patch_(patch) {
    std::vector<int> around(patch.faces.size() - 1);
    for (size_t i = 0; i < around.size(); ++i)
      around[i] = static_cast<int>(i) + 1;
    if (!around.empty()) add("hole", around, {});
    for (int vertex : patch.vertices)
      if (!mesh.sharp_at.empty())
        for (const Mesh::Sharp& sharp : mesh.sharp_at[static_cast<size_t>(vertex)])
          add_sharp(vertex, sharp);
    for (const Tag& tag : mesh.tags)
      if (tag.name != "hole")
        add(tag.name, {tag.ints.begin(), tag.ints.end()}, {tag.floats.begin(), tag.floats.end()});
  }
  void store(RequestCall& call) {
    call.arguments[3].strings = std::move(names_);
    call.arguments[4].ints = std::move(nargs_);
    call.arguments[5].ints = std::move(ints_);
    call.arguments[6].numbers = std::move(floats_);
    for (size_t i = 3; i <= 6; ++i)
      call.arguments[i].present = true;
  }

private:
  void add(const std::string& name, const std::vector<int>& ints, const std::vector<float>& floats) {
    names_.push_back(name);
    nargs_.insert(nargs_.end(), {static_cast<int>(ints.size()), static_cast<int>(floats.size())});
    ints_.insert(ints_.end(), ints.begin(), ints.end());
    floats_.insert(floats_.end(), floats.begin(), floats.end());
  }
  void add_sharp(int vertex, const Mesh::Sharp& sharp) {
    auto to = patch_.renumber.find(sharp.to);
    if (to == patch_.renumber.end()) return;
    const int from = patch_.renumber.at(vertex);
    if (sharp.to == vertex)
      add("corner", {from}, {sharp.sharpness});
    else
      add("crease", {from, to->second}, {sharp.sharpness});
  }

  const Patch& patch_;
  std::vector<std::string> names_;
  std::vector<int> nargs_, ints_;
  std::vector<float> floats_;
};

/// A limit surface stays within this many times the box of its face, if the vertices around are no farther
/// out than the face is wide: at a regular corner those on one side weigh 1/6 together.
constexpr float kOutreach = 4.0f / 3;

/// Where the vertices of the patch lie in the cell about `middle`.
Param flat_positions(const Mesh& mesh, const Patch& patch, const Plane& plane, float scale, Vec2 middle) {
  Param P;
  P.token = "P";
  P.integers = false;
  const Vec2 centre = 0.5f * (plane.least + plane.most);
  for (int vertex : patch.vertices) {
    const Vec2 flat = glm::clamp(plane.flat(mesh.P[static_cast<size_t>(vertex)]),
                                 plane.least - plane.extent(), plane.most + plane.extent());
    const Vec2 at = middle + scale * (flat - centre);
    P.numbers.insert(P.numbers.end(), {at.x, at.y, 0.5f});
  }
  return P;
}

/// All variables but P, with their types. The error is that of a token, or of a wrong number of values.
slvm::Result<std::vector<std::pair<const Param*, Declaration>>>
variables(const RequestCall& call, const Declarations& declarations, const Mesh& mesh) {
  std::vector<std::pair<const Param*, Declaration>> out;
  for (const Param& param : call.params) {
    auto d = declarations.resolve(param.token);
    if (!d) return slvm::Error{d.error()};
    if (d->name == "P") continue;
    const size_t values = d->storage == StorageClass::kConstant      ? 1
                          : d->storage == StorageClass::kUniform     ? mesh.nvertices.size()
                          : d->storage == StorageClass::kFaceVarying ? mesh.vertices.size()
                                                                     : mesh.P.size();
    const size_t found = param.is_string() ? param.strings.size() : param.numbers.size();
    if (found != values * static_cast<size_t>(d->width()))
      return slvm::Error{fmt::format("\"{}\" takes {} numbers, found {}", param.token,
                                     values * static_cast<size_t>(d->width()), found)};
    out.emplace_back(&param, std::move(*d));
  }
  return out;
}

} // namespace

slvm::Result<size_t> fragment_mesh(const RequestCall& call, const Declarations& declarations,
                                   const std::function<void(const RequestCall&)>& piece) {
  Mesh mesh;
  if (std::string wrong = read_mesh(call, mesh); !wrong.empty()) return slvm::Error{wrong};
  auto vars = variables(call, declarations, mesh);
  if (!vars) return slvm::Error{vars.error()};

  struct Piece {
    int face;
    Plane plane;
  };
  std::vector<Piece> pieces;
  float widest = 0;
  for (int f = 0; f < static_cast<int>(mesh.nvertices.size()); ++f) {
    const auto corners = mesh.corners(f);
    const bool at_border = std::any_of(corners.begin(), corners.end(),
                                       [&](int v) { return mesh.border[static_cast<size_t>(v)]; });
    if (mesh.hole[static_cast<size_t>(f)] || (at_border && !mesh.to_the_border)) continue;
    auto plane = plane_of(mesh, f);
    if (!plane) continue;
    widest = std::max({widest, plane->extent().x, plane->extent().y});
    pieces.push_back({f, *plane});
  }
  const auto columns = std::max(1.0f, std::ceil(std::sqrt(static_cast<float>(pieces.size()))));
  const float cell = 1 / columns, scale = cell / (kOutreach * widest);
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Patch patch = patch_of(mesh, pieces[i].face);
    const Vec2 middle((std::fmod(static_cast<float>(i), columns) + 0.5f) * cell,
                      (std::floor(static_cast<float>(i) / columns) + 0.5f) * cell);
    RequestCall out;
    out.id = RequestId::kSubdivisionMesh;
    out.where = call.where;
    out.arguments.resize(call.arguments.size());
    out.arguments[0] = call.arguments[0];
    out.arguments[1].present = out.arguments[2].present = true;
    for (int f : patch.faces) {
      const auto corners = mesh.corners(f);
      out.arguments[1].ints.push_back(static_cast<int>(corners.size()));
      for (size_t k = 0; k < corners.size(); ++k)
        out.arguments[2].ints.push_back(patch.renumber.at(corners[turned(k, corners.size())]));
    }
    PatchTags(mesh, patch).store(out);
    out.params.push_back(flat_positions(mesh, patch, pieces[i].plane, scale, middle));
    Param pref = *call.find_param("P");
    pref.token = "vertex point ScatterPref";
    out.params.push_back(
        select(pref, {"ScatterPref", StorageClass::kVertex, slvm::Type::kPoint}, mesh, patch));
    Param number;
    number.token = "constant float ScatterFace";
    number.integers = false;
    number.numbers = {static_cast<float>(pieces[i].face)};
    out.params.push_back(std::move(number));
    for (const auto& [param, declaration] : *vars)
      out.params.push_back(select(*param, declaration, mesh, patch));
    piece(out);
  }
  return pieces.size();
}

void Fragmenter::request(const RequestCall& call) {
  if (call.id == RequestId::kDeclare) {
    if (auto declared = declarations_.declare(call.text(0), call.text(1)); !declared)
      diagnostics_.error(call.where, fmt::format("Declare: {}", declared.error()));
    return;
  }
  if (call.id != RequestId::kSubdivisionMesh || meshes_++ != wanted_) return;
  auto made = fragment_mesh(call, declarations_, [this](const RequestCall& piece) { out_.request(piece); });
  if (!made)
    diagnostics_.error(call.where, fmt::format("SubdivisionMesh: {}", made.error()));
  else if (*made == 0)
    diagnostics_.warning(call.where, "rib",
                         "SubdivisionMesh: no face can be laid out; a mesh with an open boundary needs the "
                         "tag \"interpolateboundary\"");
}

FragmentSource fragment_source(std::string_view data) {
  FragmentSource source;
  if (data.find("SubdivisionMesh") != data.npos) {
    source.text = data;
    return source;
  }
  while (!data.empty() && data.back() == ' ')
    data.remove_suffix(1);
  const size_t blank = data.rfind(' ');
  if (blank != data.npos) {
    const std::string_view number = data.substr(blank + 1);
    auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), source.mesh);
    if (error == std::errc() && end == number.data() + number.size() && source.mesh >= 0)
      data = data.substr(0, blank);
    else
      source.mesh = 0;
  }
  source.file = data;
  return source;
}

} // namespace render
