// Scalar fields of meshes: how far each vertex is from chosen ones along edges, as primitive variables that
// shaders read. After "Shading a Coral Reef" (Bernardi, RenderMan, Theory and Practice, SIGGRAPH 2003 course
// 9).
#pragma once

#include "render/rib/ri_target.h"
#include "slvm/support/diagnostics.h"
#include "slvm/support/result.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace render::tools {

/// A mesh as a graph of vertices and edges.
struct MeshGraph {
  std::span<const float> points; ///< x y z of each vertex, in the space of the mesh
  std::vector<std::vector<int>> neighbours;

  int size() const { return static_cast<int>(neighbours.size()); }
};

/// Of faces as RIB has them: corners of each face, vertex of each corner. Vertices out of the range of
/// `points` are an error.
slvm::Result<MeshGraph> make_mesh_graph(std::span<const int> corners, std::span<const int> vertices,
                                        std::span<const float> points);

/// How distance is counted: edges on the way, or their lengths.
enum class Distance { kSteps, kLength };

/// From the nearest of `from` to each vertex; infinity where no edges lead.
std::vector<float> mesh_distances(const MeshGraph&, std::span<const int> from, Distance);

/// Vertices that are farther than all around them: the ends of branches. Vertices of the same distance side
/// by side count as one place.
std::vector<int> mesh_ends(const MeshGraph&, std::span<const float> distances);

/// A choice of vertices: "3,17,4" (numbers), "low:y:0.05" (those within the lowest 5 % of the mesh along an
/// axis, at least the lowest one), "high:x:0.1", or "ends" (see mesh_ends, by distances from the base).
class VertexChoice {
public:
  static slvm::Result<VertexChoice> parse(std::string_view text);
  bool is_ends() const { return kind_ == Kind::kEnds; }
  /// Not for ends. The error names a vertex that the mesh does not have.
  slvm::Result<std::vector<int>> vertices(const MeshGraph&) const;

private:
  enum class Kind { kNumbers, kLow, kHigh, kEnds };
  Kind kind_ = Kind::kEnds;
  std::vector<int> numbers_;
  int axis_ = 1;
  float part_ = 0;
};

struct FieldSettings {
  VertexChoice base, tips;
  Distance distance = Distance::kSteps;
  std::string base_name = "basedistance", tip_name = "tipdistance";
};

/// Hands requests on to `next`; SubdivisionMesh and PointsPolygons get both fields on the way, each 0 at the
/// chosen vertices and 1 at the farthest. Fields of these names that they have already are replaced.
class MeshFields : public RiTarget {
public:
  MeshFields(RiTarget& next, const FieldSettings& settings, slvm::Diagnostics& diagnostics)
      : next_(next), settings_(settings), diagnostics_(diagnostics) {}

  void request(const RequestCall& call) override;
  void unknown_request(std::string_view name, std::string_view suggestion, slvm::SourceRange where) override;
  bool wants_comments() const override { return next_.wants_comments(); }
  void comment(std::string_view text, slvm::SourceRange where) override { next_.comment(text, where); }
  /// Meshes so far.
  int count() const { return count_; }

private:
  bool add_fields(RequestCall& call);

  RiTarget& next_;
  const FieldSettings& settings_;
  slvm::Diagnostics& diagnostics_;
  int count_ = 0;
};

} // namespace render::tools
