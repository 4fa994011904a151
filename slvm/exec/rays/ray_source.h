// The points that shoot rays in one call, and all that decides where their rays go. Only active points are
// here, one behind the other. What is read from operands is copied: a loop's body may change the variables
// they are.
#pragma once

#include "slvm/exec/rays/call_tokens.h"
#include "slvm/support/sample_sequence.h"

#include <limits>

namespace slvm {

/// What a call says about its rays.
struct RaySpec {
  Operand origin;
  Operand direction;            ///< axis of the cone, of any length
  bool direction_counts = true; ///< false: it comes from elsewhere
  bool to_target = false;       ///< `direction` is a point instead: rays are no longer than to there
  PointValue angle = 0;         ///< half angle of the cone; 0: the axis itself
  PointValue samples = 1;
  bool may_be_none = false; ///< points whose samples are 0 shoot nothing; else one at least
  PointValue bias = -1;
  PointValue max_distance = std::numeric_limits<float>::infinity();
  PointValue sample_base = 0; ///< part of the element that origins are spread over
  PointValue weight = 1;
  bool cosine = false;        ///< as dense as the cosine to the axis; else equally dense
  bool differentials = false; ///< what is hit is shaded, and filters
};

/// Per-point arrays of a RaySource; a triple by component.
using PointArray = std::vector<float>;
using PointTriples = PointArray[3];

class RaySource {
public:
  /// The active points of the call's run. Points without direction shoot no rays.
  void begin(const GridCall& call, const RaySpec& spec, uint32_t seed);

  size_t size() const { return point.size(); }
  uint32_t most_samples() const { return most_samples_; }
  /// Rays are spread over cones or elements: neighbouring points' rays differ by chance.
  bool scattered() const { return scattered_; }

  std::vector<uint32_t> point; ///< on the grid
  std::vector<uint32_t> samples;
  std::vector<uint32_t>
      seeds[kSampleUses];      ///< of the scramblings; of the element only where origins are spread
  std::vector<uint8_t> shoots; ///< origin and direction are proper ones
  PointTriples origin, axis, tangent, bitangent;
  PointArray cosine_of_angle, squared_sine; ///< of the cones; empty: there are none
  PointArray spread;                        ///< side of the part of the cone that is one sample's
  /// Differentials of directions: a multiple of the axis' change, wider by the sample's part of the cone; or,
  /// where the axis hardly turns, that part itself.
  PointArray turn_scale[2], across[2];
  PointArray bias, max_distance; ///< empty: the defaults
  PointTriples weight;           ///< empty: 1
  PointArray base;               ///< empty: origins are not spread
  /// Change of origin and axis to the next point; empty where neither spread origins nor differentials want
  /// it. And that of a ray's origin: less where several samples share the element.
  PointTriples origin_u, origin_v, axis_u, axis_v, ray_origin_u, ray_origin_v;
  bool any_across = false; ///< some of `across` is not 0
  bool cosine = false, differentials = false;

private:
  void read_points(const ShaderRun& run, const RaySpec& spec, uint32_t call_seed);
  void read_direction(const RaySpec& spec, size_t at);
  void read_cones(const RaySpec& spec);
  void read_differences(const GridCall& call, const RaySpec& spec, uint32_t call_seed);
  void turn_axes(const RaySpec& spec);
  void read_widths();

  uint32_t most_samples_ = 0;
  bool scattered_ = false;
};

/// Two directions of length 1 across `z`, of length 1 itself.
void directions_across(const float (&z)[3], float (&x)[3], float (&y)[3]);

} // namespace slvm
