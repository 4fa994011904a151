// The ground that repels a Blobby (code 1003): heights above the surface in a depth image, and the field of
// them.
#pragma once

#include "render/state/math.h"
#include "render/texture/depth_image.h"

namespace render {

class BlobbyGround {
public:
  /// The image has matrices; `object_to_world` is that of the Blobby.
  BlobbyGround(DepthImage image, const Matrix4& object_to_world);

  /// How far a point is in front of the surface, along the view of the image's camera: negative behind it,
  /// infinite where the image shows nothing. Between pixel centres depths are interpolated.
  double height(glm::dvec3 p) const;

private:
  DepthImage image_;
  Matrix4 to_camera_, to_screen_; ///< from object space
};

/// What repels: falls off to 0 at a height, bulges below it, and goes down to minus infinity on the ground
/// (PRMan application note 31).
struct GroundProfile {
  float reach = 1;     ///< A: no effect from this height on
  float sharpness = 0; ///< B: near the ground the field is -B / height
  float peak = 1;      ///< C: height at which the bulge is highest; it ends at twice that
  float bulge = 0;     ///< D: its field there
  double at(double height) const;
};

} // namespace render
