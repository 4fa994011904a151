// Everything that may change from primitive to primitive. Plain data, defaults of the RISpec; shared between
// primitives and copied when a request changes it.
#pragma once

#include "render/state/level_of_detail.h"
#include "render/state/math.h"
#include "render/state/ray_attributes.h"
#include "render/state/shader_request.h"
#include "slvm/value.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace render {

struct TrimRegion;

/// Which side is the outside: that of the primitive's own definition, the other, or absolutely by handedness
/// of dPdu x dPdv in camera space.
enum class Orientation : uint8_t { kOutside, kInside, kLeftHanded, kRightHanded };

/// A cubic basis: value = [t^3 t^2 t 1] M [p0 p1 p2 p3].
struct CubicBasis {
  Matrix4 matrix;
  int step = 3;
};
CubicBasis bezier_basis();

/// How the micropolygons of a surface are cut: Attribute "dice", GeometricApproximation.
struct Dicing {
  bool raster_oriented = true; ///< false: sizes as if the surface faced the eye
  bool binary = false;         ///< powers of two, also where nothing asks for them
  bool hair = false;           ///< curves are one micropolygon wide
  float shortest = 0;          ///< side of a micropolygon in pixels, at least
  float motion_factor = 1, focus_factor = 1;
};

struct Attributes {
  Color color{1, 1, 1}, opacity{1, 1, 1};
  bool matte = false;
  int sides = 2;
  Orientation orientation = Orientation::kOutside;
  float shading_rate = 1;
  Dicing dicing;
  bool stitch = true;            ///< grids of curved surfaces are fitted to each other
  float back_face_tolerance = 0; ///< degrees that one-sided surfaces may face away
  LevelOfDetail detail;
  bool smooth_shading = false;
  std::array<float, 8> texture_coordinates{0, 0, 1, 0, 0, 1, 1, 1};
  CubicBasis ubasis = bezier_basis(), vbasis = bezier_basis();
  std::shared_ptr<const TrimRegion> trim; ///< of NURBS patches; null: they are whole

  std::shared_ptr<const ShaderRequest> surface, displacement, atmosphere, interior, exterior;
  /// Lights that are on, in order of declaration.
  std::vector<std::shared_ptr<const ShaderRequest>> lights;
  std::shared_ptr<const ShaderRequest> area_light; ///< whose surface primitives are; null: of none

  /// Farthest a displacement shader moves a point, and the space that is measured in.
  float displacement_sphere = 0;
  std::string displacement_space = "object";
  std::string name; ///< Attribute "identifier" "name"
  /// Whatever else attribute() can ask for, by "category:parameter".
  std::map<std::string, slvm::Value> named;
  /// Attribute "cull": false shades what cannot be seen, too, as baking needs it.
  bool cull_hidden = true, cull_backfacing = true;
  RayAttributes rays;
  /// Spaces named by ScopedCoordinateSystem, to camera.
  std::map<std::string, Matrix4> scoped_spaces;

  /// Whether Du(P) ^ Dv(P) in camera space points to the inside, for an object space mirrored or not.
  bool flips_normals(bool mirrored) const {
    switch (orientation) {
    case Orientation::kOutside: return mirrored;
    case Orientation::kInside: return !mirrored;
    case Orientation::kLeftHanded: return false;
    case Orientation::kRightHanded: return true;
    }
    return false;
  }
};

} // namespace render
