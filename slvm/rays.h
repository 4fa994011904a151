// What trace(), gather(), transmission(), occlusion() and their relatives ask of a renderer: many rays at
// once. PUBLIC, abstract: render/rays implements it with Embree; so can an embedder.
//
// The machine makes the rays (slvm/exec/rays): it knows the shader's arguments, the grid's derivatives and
// where samples go, which are functions of grid, point, call and sample only. The renderer knows what the
// rays hit, runs the shaders there on grids of its own, whose Grid::ray tells them of it, and ends rays that
// are too deep or weigh too little. Everything geometric is in "current" space.
#pragma once

#include "slvm/format/types.h"
#include "slvm/support/matrix.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace slvm {

struct ShadingState; // slvm/renderer_services.h

/// Decides which objects a ray sees (Attribute "visibility") and which limit of depth it counts against.
enum class RayKind : uint8_t { kSpecular, kDiffuse, kTransmission };

/// Which sides of surfaces rays hit: those their normals point to, the other ones, or both.
enum class HitSides : uint8_t { kBoth, kFront, kBack };

/// How the opacity or colour of a hit is found: as the attributes of the object say, from the primitive
/// alone, or by its shaders.
enum class HitMode : uint8_t { kDefault, kPrimitive, kShader };

/// What is the same for all rays of a call.
struct RayOptions {
  RayKind kind = RayKind::kSpecular;
  HitSides sides = HitSides::kBoth;
  HitMode mode = HitMode::kDefault;
  std::string_view label; ///< rayinfo("label") at the hits
  std::string_view
      subset; ///< groups that can be hit: names apart by spaces or commas, "-name" leaves out; empty: all
  bool shades = true;         ///< false: no shader of any hit runs (gather's category "occlusion")
  bool wants_distance = true; ///< false: of a hit the distance may be 0, if nothing else is wanted either
  uint32_t seed = 0;          ///< of what is random: differs from call to call of one run of a shader
};

/// Rays as structures of arrays, `count` long. Directions have length 1.
struct RayBatch {
  size_t count = 0;
  const float* origin[3] = {};
  const float* direction[3] = {};
  /// What origin and direction change by to the neighbouring points of the grid, for filtering at the hit
  /// (Igehy, Tracing Ray Differentials, 1999). Null: rays without width.
  const float *origin_du[3] = {}, *origin_dv[3] = {}, *direction_du[3] = {}, *direction_dv[3] = {};
  const float* max_distance = nullptr; ///< farther surfaces are not hit; null: no limit
  const float* bias = nullptr;     ///< hits nearer than this are left out; negative or null: the attribute's
  const float* weight[3] = {};     ///< part of the picture each ray makes, at most; null: 1
  const uint32_t* point = nullptr; ///< of the grid, to which each ray belongs
  /// Number of the ray among those of its point; with `point`, Grid::id and RayOptions::seed the seed of what
  /// is random.
  const uint32_t* sample = nullptr;
};

/// A value wanted of every hit.
struct RayOutput {
  /// Of which shader at the hit the variable is: a parameter or a predefined variable after that shader ran.
  /// kPrimitive: a predefined or primitive variable before any shader ran. kAttribute: as attribute() names
  /// it. kVolume: the volume shader on the side the ray comes from. kShaded: a predefined variable after all
  /// shaders ran, as a camera sees it.
  enum class From : uint8_t {
    kSurface,
    kDisplacement,
    kVolume,
    kAtmosphere,
    kInterior,
    kExterior,
    kPrimitive,
    kAttribute,
    kShaded
  };
  From from = From::kSurface;
  std::string_view name;
  Type type = Type::kFloat;
  uint32_t elements = 0; ///< array length; 0: no array
  /// Component c of element e of ray r at data[(e * components(type) + c) * pitch + r]; strings as handles of
  /// the machine's pool. Kept where the ray misses or the hit has no such variable of this type.
  float* data = nullptr;
  size_t pitch = 0;
  /// One a ray, 0 before the call: set to 1 where a value was stored.
  uint8_t* found = nullptr;
};

/// The distance of a ray that was not shot: it would be too deep, or weighs too little.
inline constexpr float kNotShot = -1.0f;

/// Where along a ray traverse() is: the surface met last.
struct RayCursor {
  float distance = -std::numeric_limits<float>::infinity();
  uint32_t primitive = 0, face = 0; ///< the renderer's own numbers, to tell surfaces in the same place apart
};

/// Points whose surroundings are looked at: occlusion() and indirectdiffuse(). Arrays are as long as
/// `points`.
struct HemisphereQuery {
  RayOptions rays; ///< kind kDiffuse; shades only for radiance
  size_t points = 0;
  const uint64_t* mask = nullptr; ///< a bit a point, 64 a word: points that are off need no result
  const float* position[3] = {};
  const float* normal[3] = {}; ///< length 1; the axis of the cone
  const float *along_u[3] = {},
              *along_v[3] = {};       ///< sides of the element at the point: area, footprint, samplebase
  float samples = 1, min_samples = 0; ///< rays a point; 0: no fewer than samples
  bool cosine = true;                 ///< rays as dense as the cosine to the axis; false: equally dense
  const float* cone_angle = nullptr;  ///< half angle, up to PI; null: PI/2
  const float *max_distance = nullptr, *bias = nullptr; ///< as of RayBatch
  const float* sample_base = nullptr; ///< part of the element origins are spread over; null: 0
  const float* weight[3] = {};        ///< part of the picture the result makes, at most; null: 1
  float falloff = 0;
  bool falloff_is_power = false; ///< ((maxdist - d) / maxdist)^falloff instead of exp(-falloff d)
  /// Tolerances of interpolation between points; negative: the attributes'. 0: every point by rays.
  float max_error = -1, max_pixel_distance = -1;
  std::string_view environment_map; ///< looked up where rays miss; "": none
  Matrix4 to_environment;           ///< from "current" to the axes of that map
  std::string_view cache_space;     ///< in which points of the cache are kept ("coordsystem")

  // Results, null when not wanted.
  float* occlusion = nullptr;           ///< blocked part, 0 to 1, weighted as the rays are
  float* radiance[3] = {};              ///< mean colour of hits and map
  float* environment_colour[3] = {};    ///< mean colour of the map over all rays, hits counting as black
  float* environment_direction[3] = {}; ///< mean direction of rays that missed, length 1; 0 when none did
};

/// Directions as a map's light comes: dense where it is bright. Arrays are `count` long.
struct EnvironmentSamples {
  std::string_view map;
  size_t count = 0;
  /// Numbers from 0 to 1, well spread: the warp keeps near ones near each other. Rows and columns of the map.
  const float* random[2] = {};
  // Results:
  float* direction[3] = {}; ///< length 1, in the axes environment() takes
  float* colour[3] = {};    ///< of the map there
  float* density = nullptr; ///< of directions, in 1 / steradian; 0: no light comes from anywhere
};

/// Calls come from many threads at once, also from within each other: shaders at hits trace rays, too.
/// `state` is that of the shader that asks; its grid's `ray` says how deep it is.
class RayServices {
public:
  virtual ~RayServices() = default;

  /// Whether rays meet nothing, whatever they are like: then they need not be made. Asked often.
  virtual bool is_empty() { return false; }

  /// The nearest hit of each ray: its distance, infinite for a miss, kNotShot for a ray that was not shot,
  /// and the outputs. With `cursors`, one a ray, the nearest hit behind each cursor, which moves there.
  virtual void trace(const ShadingState& state, const RayOptions&, const RayBatch&,
                     std::span<const RayOutput> outputs, float* distance, RayCursor* cursors) = 0;

  /// How much light comes through from origin to origin + max_distance * direction: the product of 1 -
  /// opacity of all that is between, by colour. 0 when nothing does. What is nearer than the bias to either
  /// end is left out: ends lie on surfaces.
  virtual void transmission(const ShadingState& state, const RayOptions&, const RayBatch&,
                            float* const (&through)[3]) = 0;

  /// "" or a warning (the environment map is missing); results are set all the same.
  virtual std::string hemisphere(const ShadingState& state, const HemisphereQuery&) = 0;

  /// "" or why the map cannot be used; densities are then 0.
  virtual std::string sample_environment(const ShadingState& state, const EnvironmentSamples&) = 0;
};

} // namespace slvm
