// Subdivision meshes laid out flat for scatter maps (E. Tomson, "Human Skin for Finding Nemo", 5.4, chapter 5
// of the SIGGRAPH 2003 course 9): each face becomes a small mesh of its own in a cell of the unit square,
// with the faces around it, which shape its limit surface and are holes themselves. Rendered with "NDC" as
// object space it fills the picture, whose pixels are then samples of the whole surface. Procedural
// "Fragment" and the program slfragment.
#pragma once

#include "render/rib/ri_target.h"
#include "render/state/declaration.h"
#include "slvm/support/diagnostics.h"

#include <functional>

namespace render {

/// The pieces of a SubdivisionMesh request: SubdivisionMesh requests with one face that is drawn. Their "P"
/// is flat, x and y in [0, 1], y down, z 1/2; "vertex point ScatterPref" is where the mesh has its points,
/// "constant float ScatterFace" the number of the face; all other variables and tags are those of the mesh.
/// All pieces have the same scale. The corners of faces turn the other way, as "NDC" mirrors, so that
/// calculatenormal(ScatterPref) is the mesh's own. Faces at a border are pieces if the mesh has the tag
/// "interpolateboundary"; faces without extent are none. The error says what is wrong with the mesh.
slvm::Result<size_t> fragment_mesh(const RequestCall& mesh, const Declarations& declarations,
                                   const std::function<void(const RequestCall&)>& piece);

/// Takes RIB and passes on the pieces of one of its meshes. Declare counts, all other requests are left out.
class Fragmenter : public RiTarget {
public:
  /// `known`: declarations at the beginning. `mesh`: which one, from 0. Messages go to `diagnostics`. Both
  /// references must outlive the fragmenter.
  Fragmenter(RiTarget& out, slvm::Diagnostics& diagnostics, Declarations known, int mesh)
      : out_(out), diagnostics_(diagnostics), declarations_(std::move(known)), wanted_(mesh) {}

  void request(const RequestCall& call) override;
  void unknown_request(std::string_view, std::string_view, slvm::SourceRange) override {}
  /// Meshes seen so far.
  int meshes() const { return meshes_; }

private:
  RiTarget& out_;
  slvm::Diagnostics& diagnostics_;
  Declarations declarations_;
  int wanted_, meshes_ = 0;
};

/// What the data of the procedural or the program says: `data` is RIB if "SubdivisionMesh" is in it, else the
/// name of a file, and behind a blank the number of a mesh in it, from 0.
struct FragmentSource {
  std::string file, text; ///< one of them is empty
  int mesh = 0;
};
FragmentSource fragment_source(std::string_view data);

} // namespace render
