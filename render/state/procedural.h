// Geometry made on demand: the Procedural request with the state it was met in. It waits until it is known
// whether its bound can be seen; only then is its archive read or its program asked.
#pragma once

#include "render/prims/motion.h"
#include "render/state/attributes.h"
#include "render/state/camera.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render {

/// Makes the geometry of a procedural by requests to the interpreter: a function of the C interface. It is
/// destroyed when it has done so, or when it is known that nobody sees it.
class GeometryMaker {
public:
  virtual ~GeometryMaker() = default;
  /// `detail`: pixels the bound covers.
  virtual void make(float detail) = 0;
};

struct Procedural {
  std::string type;
  std::vector<std::string> arguments;
  std::shared_ptr<GeometryMaker> maker; ///< where there is no type
  Box bound; ///< object space
  std::shared_ptr<Attributes> attributes;
  Matrix4 object_to_camera; ///< when the shutter opens
  MotionMatrices motion;    ///< when it moves
  std::string folder;       ///< of the file it stands in
  int depth = 0;            ///< procedurals it came from
  bool may_run = false;     ///< programs
  slvm::SourceRange where;
};

/// Pixels a box in camera space covers in the image, at most; nothing when the camera cannot see it.
std::optional<float> visible_area(const Camera& camera, const Options& options, const Box& box);

} // namespace render
