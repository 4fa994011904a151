// The dice half of REYES: a piece of a primitive becomes a shading grid in camera space, with all the
// variables a shader can read.
#pragma once

#include "render/prims/split.h"
#include "slvm/grid.h"

#include <bitset>
#include <functional>
#include <span>

namespace slvm {
class StringPool;
}

namespace render {

/// What grids hold besides geometry.
struct DiceContext {
  const Camera* camera = nullptr;
  slvm::StringPool* strings = nullptr; ///< of the virtual machine, for string primvars
  float time = 0, dtime = 0;
};

/// Points of one primitive that follow each other in a grid.
struct SurfacePoints {
  const Primitive* primitive = nullptr;
  UvPoints at;
  size_t first = 0;    ///< number of the first of them in the grid
  bool beside = false; ///< neighbours of hits (slvm::Lattice::kHits)
};

/// What somebody reads of a grid; by default everything.
struct ReadVariables {
  using Predefined = std::bitset<slvm::kGlobalCount>;
  using OfPrimitives = std::function<bool(const std::string& name)>;
  Predefined predefined = Predefined().set();
  OfPrimitives of_primitives; ///< empty: all
  /// Of these also at neighbours of hits.
  Predefined predefined_beside = Predefined().set();
  OfPrimitives of_primitives_beside; ///< empty: all

  bool has(slvm::Global g) const { return predefined[static_cast<size_t>(g)]; }
  bool has_beside(slvm::Global g) const { return predefined_beside[static_cast<size_t>(g)]; }
};

/// Fills `grid` (its old content is dropped) with the lattice of `task`, whose pieces these are. `id` becomes
/// part of the seed of random(). What nobody reads is left out as dice_points() does.
void dice(std::span<const Primitive> pieces, const GridTask& task, uint64_t id, const DiceContext& context,
          const ReadVariables& read, slvm::Grid& grid);

/// Only P, on the same lattice.
void dice_positions(std::span<const Primitive> pieces, const GridTask& task, slvm::Grid& grid);

/// Some points of that lattice, by their numbers in it, ascending: as hits. `beside`: with their neighbours
/// along u and v, which they must have.
void dice_some(std::span<const Primitive> pieces, const GridTask& task, std::span<const uint32_t> points,
               bool beside, uint64_t id, const DiceContext& context, const ReadVariables& read,
               slvm::Grid& grid);

/// Fills P, N, tangents and the geometric normal of some of a grid's points; `lattice` is what the geometry
/// of the primitives gives at each, by their numbers in the grid. The last three are left out where nobody
/// reads them. The primitives are alike in all that is the same for a grid: texture coordinates, the side
/// their normals are on, variables of the same names and kinds; constant ones have the same values, unless
/// they replace predefined ones.
void dice_geometry(std::span<const SurfacePoints> parts, const SurfaceLattice& lattice,
                   const ReadVariables& read, slvm::Grid& grid);

/// Fills the rest, but for I, du and dv; `parts` are together all points of the grid. "object" is the space
/// of the first one, and attribute() tells of it. Variables that nobody reads are left out: those of
/// primitives, and u, v, s and t together.
void dice_variables(std::span<const SurfacePoints> parts, const DiceContext& context,
                    const ReadVariables& read, slvm::Grid& grid);

/// The predefined variable that a primitive variable replaces, or kCount. "st" is none: it replaces two.
slvm::Global replaced_variable(const PatchVar& var);
/// Whether a primitive variable is "st".
bool is_st(const PatchVar& var);

/// After P was moved: I, Ng, dPdu and dPdv anew, the latter from differences of P. N stays what the
/// displacement shader left.
void renew_geometry(const Camera& camera, slvm::Grid& grid);

/// dPdtime of a grid, from where its points are when the shutter closes, `duration` later.
void set_motion(slvm::Grid& grid, const slvm::Grid& at_close, float duration);

/// Whether every point faces away from the eye, by Ng.
bool faces_away(const slvm::Grid& grid, const Camera& camera);

} // namespace render
