#include "render/tools/mesh_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <queue>

namespace render::tools {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

float edge_length(const MeshGraph& mesh, int a, int b) {
  float sum = 0;
  for (int k = 0; k < 3; ++k) {
    float d = mesh.points[3 * a + k] - mesh.points[3 * b + k];
    sum += d * d;
  }
  return std::sqrt(sum);
}

template <class T> bool parse_number(std::string_view text, T& value) {
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// So that the farthest vertex has 1. What cannot be reached has 1, too.
int normalise(std::vector<float>& field) {
  float longest = 0;
  int unreached = 0;
  for (float d : field)
    if (d < kFar) longest = std::max(longest, d);
  for (float& d : field) {
    if (!(d < kFar)) ++unreached;
    d = !(d < kFar) ? 1 : longest > 0 ? d / longest : 0;
  }
  return unreached;
}

/// The name in "varying float name", or the whole token.
std::string_view variable_name(std::string_view token) {
  size_t blank = token.find_last_of(" \t");
  return blank == std::string_view::npos ? token : token.substr(blank + 1);
}

const Param* find_points(const RequestCall& call) {
  auto found = std::find_if(call.params.begin(), call.params.end(),
                            [](const Param& p) { return variable_name(p.token) == "P"; });
  return found == call.params.end() || found->is_string() ? nullptr : &*found;
}

} // namespace

slvm::Result<MeshGraph> make_mesh_graph(std::span<const int> corners, std::span<const int> vertices,
                                        std::span<const float> points) {
  MeshGraph mesh{points, {}};
  mesh.neighbours.resize(points.size() / 3);
  size_t first = 0;
  for (int n : corners) {
    if (n < 1 || first + static_cast<size_t>(n) > vertices.size())
      return slvm::Error{"its faces have more corners than it has vertex numbers"};
    for (int k = 0; k < n; ++k) {
      int a = vertices[first + k], b = vertices[first + (k + 1) % n];
      if (a < 0 || a >= mesh.size())
        return slvm::Error{fmt::format("a face has vertex {}, but P has {}", a, mesh.size())};
      if (b < 0 || b >= mesh.size() || a == b) continue; // told when it is the first of an edge
      mesh.neighbours[a].push_back(b);
      mesh.neighbours[b].push_back(a);
    }
    first += static_cast<size_t>(n);
  }
  return mesh;
}

std::vector<float> mesh_distances(const MeshGraph& mesh, std::span<const int> from, Distance kind) {
  std::vector<float> distance(static_cast<size_t>(mesh.size()), kFar);
  using Place = std::pair<float, int>;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
  for (int v : from) {
    distance[v] = 0;
    next.emplace(0.0f, v);
  }
  while (!next.empty()) {
    auto [d, v] = next.top();
    next.pop();
    if (d > distance[v]) continue;
    for (int w : mesh.neighbours[v]) {
      float there = d + (kind == Distance::kSteps ? 1 : edge_length(mesh, v, w));
      if (there < distance[w]) {
        distance[w] = there;
        next.emplace(there, w);
      }
    }
  }
  return distance;
}

std::vector<int> mesh_ends(const MeshGraph& mesh, std::span<const float> distances) {
  std::vector<int> ends;
  std::vector<bool> seen(distances.size(), false);
  for (int start = 0; start < mesh.size(); ++start) {
    if (seen[start] || !(distances[start] < kFar)) continue;
    // The place: all vertices of the same distance that hang together.
    std::vector<int> place{start};
    seen[start] = true;
    bool is_end = true;
    for (size_t i = 0; i < place.size(); ++i)
      for (int w : mesh.neighbours[place[i]]) {
        if (distances[w] > distances[start]) is_end = false;
        if (distances[w] != distances[start] || seen[w]) continue;
        seen[w] = true;
        place.push_back(w);
      }
    if (is_end) ends.insert(ends.end(), place.begin(), place.end());
  }
  return ends;
}

slvm::Result<VertexChoice> VertexChoice::parse(std::string_view text) {
  VertexChoice choice;
  if (text == "ends") return choice;
  std::vector<std::string_view> parts = split(text, ':');
  if (parts[0] == "low" || parts[0] == "high") {
    choice.kind_ = parts[0] == "low" ? Kind::kLow : Kind::kHigh;
    bool fine = parts.size() == 3 && parts[1].size() == 1 && parts[1][0] >= 'x' && parts[1][0] <= 'z' &&
                parse_number(parts[2], choice.part_) && choice.part_ >= 0 && choice.part_ <= 1;
    if (!fine)
      return slvm::Error{fmt::format("'{}' is no choice of vertices: write {}:AXIS:PART, such as {}:y:0.05",
                                     text, parts[0], parts[0])};
    choice.axis_ = parts[1][0] - 'x';
    return choice;
  }
  choice.kind_ = Kind::kNumbers;
  for (std::string_view part : split(text, ','))
    if (!parse_number(part, choice.numbers_.emplace_back()))
      return slvm::Error{fmt::format(
          "'{}' is no choice of vertices: write numbers (3,17), low:y:0.05, high:y:0.05 or ends", text)};
  return choice;
}

slvm::Result<std::vector<int>> VertexChoice::vertices(const MeshGraph& mesh) const {
  if (kind_ == Kind::kNumbers) {
    for (int v : numbers_)
      if (v < 0 || v >= mesh.size())
        return slvm::Error{fmt::format("there is no vertex {}: the mesh has 0 to {}", v, mesh.size() - 1)};
    return numbers_;
  }
  float sign = kind_ == Kind::kHigh ? -1.0f : 1.0f, low = kFar, high = -kFar;
  for (int v = 0; v < mesh.size(); ++v) {
    float x = sign * mesh.points[3 * v + axis_];
    low = std::min(low, x);
    high = std::max(high, x);
  }
  std::vector<int> chosen;
  for (int v = 0; v < mesh.size(); ++v)
    if (sign * mesh.points[3 * v + axis_] <= low + part_ * (high - low)) chosen.push_back(v);
  return chosen;
}

bool MeshFields::add_fields(RequestCall& call) {
  auto fail = [&](const std::string& why) {
    diagnostics_.error(call.where, why);
    return false;
  };
  bool subdivision = call.id == RequestId::kSubdivisionMesh;
  const Param* points = find_points(call);
  if (!points || points->numbers.empty()) return fail("this mesh has no points \"P\"");
  auto mesh = make_mesh_graph(call.integers(subdivision ? 1 : 0), call.integers(subdivision ? 2 : 1),
                              points->numbers);
  if (!mesh) return fail(mesh.error());
  auto base = settings_.base.vertices(*mesh);
  if (!base) return fail("base: " + base.error());
  std::vector<float> from_base = mesh_distances(*mesh, *base, settings_.distance);
  auto tips = settings_.tips.is_ends() ? slvm::Result<std::vector<int>>(mesh_ends(*mesh, from_base))
                                       : settings_.tips.vertices(*mesh);
  if (!tips) return fail("tips: " + tips.error());
  std::vector<float> from_tips = mesh_distances(*mesh, *tips, settings_.distance);
  if (int n = normalise(from_base))
    diagnostics_.warning(
        call.where, "",
        fmt::format("{} of {} vertices hang together with none of the base: they get 1", n, mesh->size()));
  normalise(from_tips);
  for (const auto& pair :
       {std::pair(&settings_.base_name, &from_base), std::pair(&settings_.tip_name, &from_tips)}) {
    const std::string& name = *pair.first;
    std::erase_if(call.params, [&](const Param& p) { return variable_name(p.token) == name; });
    Param p;
    p.token = (subdivision ? "vertex float " : "varying float ") + name;
    p.numbers = std::move(*pair.second);
    p.integers = false;
    call.params.push_back(std::move(p));
  }
  ++count_;
  return true;
}

void MeshFields::request(const RequestCall& call) {
  if (call.id != RequestId::kSubdivisionMesh && call.id != RequestId::kPointsPolygons)
    return next_.request(call);
  RequestCall with_fields = call;
  if (add_fields(with_fields)) next_.request(with_fields);
}

void MeshFields::unknown_request(std::string_view name, std::string_view suggestion,
                                 slvm::SourceRange where) {
  std::string text = fmt::format("unknown request '{}'", name);
  if (!suggestion.empty()) text += fmt::format("; did you mean '{}'?", suggestion);
  diagnostics_.error(where, std::move(text));
}

} // namespace render::tools
