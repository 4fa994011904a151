// Geometry made on demand: the Procedural request with the state it was met in. It waits until a part of the
// picture is drawn in which its bound can be seen; only then is its archive read or its program asked.
#pragma once

#include "render/prims/motion.h"
#include "render/state/attributes.h"
#include "render/state/camera.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render {

/// Makes the geometry of a procedural by requests to the interpreter: a function of the C interface. It may
/// be destroyed in any thread, when nothing is to be made any more.
class GeometryMaker {
public:
  virtual ~GeometryMaker() = default;
  /// `detail`: pixels the bound covers. Called once at most, from any thread, but never two of them at once.
  virtual void make(float detail) = 0;
};

/// The procedurals that one came out of.
struct Ancestry {
  std::string what; ///< the innermost: its type and arguments
  std::shared_ptr<const Ancestry> from;
};

struct Procedural {
  std::string type;
  std::vector<std::string> arguments;
  std::shared_ptr<GeometryMaker> maker; ///< where there is no type
  Box bound;                            ///< object space
  std::shared_ptr<Attributes> attributes;
  Matrix4 object_to_camera;             ///< when the shutter opens
  MotionMatrices motion;                ///< when it moves
  float displacement_bound = 0;         ///< of its attributes, in camera space
  SolidPlace solid;                     ///< the solid block it stands in
  std::string folder;                   ///< of the file it stands in
  std::shared_ptr<const Ancestry> from; ///< null: of the scene itself
  int depth = 0;                        ///< procedurals it came from
  bool may_run = false;                 ///< programs
  slvm::SourceRange where;
};

/// Where a procedural may be seen.
struct SeenBound {
  Vec2 raster_min, raster_max; ///< pixels, defocus included
  float zmin = 0;              ///< nearest camera z
  float area = 0;              ///< pixels its bound covers, at most
};

/// Of a box in camera space. Nothing when it is outside the picture, to which `margin` pixels belong all
/// round. What reaches behind the near plane may be anywhere in it.
std::optional<SeenBound> seen_bound(const Box&, const Camera&, Vec2 margin);
std::optional<SeenBound> seen_bound(const Procedural&, const Camera&, Vec2 margin);

} // namespace render
