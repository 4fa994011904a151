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

struct Procedural {
  std::string type;
  std::vector<std::string> arguments;
  Box bound; ///< object space
  std::shared_ptr<Attributes> attributes;
  Matrix4 object_to_camera; ///< when the shutter opens
  MotionMatrices motion;    ///< when it moves
  SolidPlace solid;         ///< the solid block it stands in
  std::string folder;       ///< of the file it stands in
  int depth = 0;            ///< procedurals it came from
  slvm::SourceRange where;
};

/// Pixels a box in camera space covers in the image, at most; nothing when the camera cannot see it.
std::optional<float> visible_area(const Camera& camera, const Options& options, const Box& box);

} // namespace render
