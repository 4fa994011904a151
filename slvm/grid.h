// A shading grid: nu x nv points and, for each, the predefined variables and primitive variables. PUBLIC.
//
// Points are numbered row by row, u fastest: point (iu, iv) is iv * nu + iu. A variable is either uniform
// (one value) or varying (structure of arrays: one plane of floats a component, pitch() floats apart, point i
// at index i). Planes are 64-byte aligned and padded to pitch(); the padding may hold anything. All geometric
// values are in "current" space. A grid of one row or column, or with `derivatives` off, has derivatives 0.
#pragma once

#include "slvm/format/shadeop_info.h"
#include "slvm/support/matrix.h"
#include "slvm/value.h"

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace slvm {

/// Where the values of one variable are; the form compiled code reads.
struct Planes {
  float* data = nullptr; ///< null: the variable was not set
  size_t pitch = 0;      ///< floats from one plane to the next
  uint32_t step = 0;     ///< 1: varying; 0: uniform (16 equal floats a plane)
  Type type = Type::kFloat;
  uint32_t elements = 0; ///< array length; 0: not an array. Element e, component c: plane e * components + c

  float get(size_t component, size_t point) const { return data[component * pitch + (step ? point : 0)]; }
};

/// The rays that hit the points of a grid: all of one kind, so that what it decides is uniform. The rays
/// themselves are I, which ends at P.
struct RayFacts {
  std::string type = "camera"; ///< "specular", "diffuse", "transmission"... for points that rays hit
  std::string label;
  float depth = 0; ///< rays before this one, as many of each kind as follow
  float specular_depth = 0, diffuse_depth = 0, shadow_depth = 0;
  /// What specular_depth and diffuse_depth may become, by the objects whose rays led here.
  float most_specular_depth = std::numeric_limits<float>::infinity(),
        most_diffuse_depth = std::numeric_limits<float>::infinity();
  /// Part of the picture that each point's ray makes, at most; null: 1. The renderer's own memory.
  const float* weight[3] = {};
};

/// How the points of a grid lie to each other.
enum class Lattice : uint8_t {
  kRows, ///< a lattice: neighbours in the grid are neighbours on the surface
  /// nu points that have nothing to do with each other: the hits of rays. They are row 0. Where shaders
  /// differentiate, nv is 3: rows 1 and 2 hold, for each, a point beside it, one step along u (du, varying)
  /// and one along v.
  kHits,
  /// Pieces of surfaces one above the other, piece_rows rows each: those of different pieces have nothing to
  /// do with each other.
  kPieces,
};

class Grid {
public:
  Grid(int nu, int nv);

  int nu() const { return nu_; }
  int nv() const { return nv_; }
  size_t points() const { return static_cast<size_t>(nu_) * static_cast<size_t>(nv_); }
  /// Floats from one plane to the next: points() rounded up to a whole number of widest vectors.
  size_t pitch() const { return pitch_; }

  /// Makes `g` varying, if it is not, and returns its first plane to be filled or read.
  float* varying(Global g);
  /// The same for who stores to all points: they hold anything before.
  float* to_fill(Global g);
  /// Makes `g` uniform with this value (components() floats). Uniform values of varying variables cost
  /// nothing.
  void set_uniform(Global g, std::span<const float> value);
  const Planes& variable(Global g) const { return globals_[static_cast<size_t>(g)]; }

  /// Primitive variables by name: they override shader parameters of the same name and type.
  float* add_varying_primvar(const std::string& name, Type type, uint32_t elements = 0);
  void add_uniform_primvar(const std::string& name, const Value& value, class StringPool&);
  const Planes* primvar(const std::string& name) const;
  std::span<const std::pair<std::string, Planes>> primvars() const { return primvars_; }

  /// Frees all variables and changes the size; memory is kept for reuse.
  void reset(int nu, int nv);

  /// The points that count: of hits, row 0.
  size_t samples() const { return lattice == Lattice::kHits ? static_cast<size_t>(nu_) : points(); }

  /// Rows that are neighbours of each other.
  int rows_of_piece() const { return lattice == Lattice::kPieces ? piece_rows : nv_; }

  Lattice lattice = Lattice::kRows;
  int piece_rows = 0; ///< a divisor of nv
  /// Of hits, nu floats each, the renderer's own memory: how many steps along u and along v a ray's footprint
  /// reaches in the one direction, then in the other one; texture lookups filter over it. Null: one step
  /// along u, one along v.
  const float* footprint[4] = {};

  /// Of hits with neighbours: nobody reads the neighbours' results, so that a shader leaves them out where no
  /// derivative looks at them any more, and needs no more of them than Instance::reads_beside() says; neither
  /// lights nor what runs after it may have derivatives of their own.
  bool neighbours_end = false;

  /// What rayinfo() tells.
  RayFacts ray;
  bool derivatives = true;
  /// calculatenormal's Du(P) ^ Dv(P) is turned round: set when the orientation or a mirroring transformation
  /// of the primitive makes the outside the other side.
  bool flip_normals = false;
  /// "object" to "current".
  Matrix4 object_to_current;
  /// Part of the seed of random(): give each grid of a frame another one.
  uint64_t id = 0;
  /// The renderer's own: which primitive this is. Handed back in every RendererServices call.
  const void* user = nullptr;

private:
  float* allocate(size_t planes, size_t pitch);

  int nu_, nv_;
  size_t pitch_;
  Planes globals_[static_cast<size_t>(kGlobalCount)];
  std::vector<std::pair<std::string, Planes>> primvars_;
  struct Block {
    std::unique_ptr<float[]> memory;
    size_t size = 0, used = 0;
  };
  std::vector<Block> blocks_;
};

} // namespace slvm
