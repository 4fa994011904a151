// From camera space to the image: screen, NDC and raster. RISpec 3.2, 4.1.
#pragma once

#include "render/state/options.h"

#include <cmath>

namespace render {

struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0; ///< x1, y1 one past the last pixel
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

class Camera {
public:
  explicit Camera(const Options&);

  const Matrix4& to_screen() const { return to_screen_; }
  const Matrix4& to_ndc() const { return to_ndc_; }
  const Matrix4& to_raster() const { return to_raster_; }
  /// Pixels of a point in front of the eye (any z when the projection is orthographic).
  Vec2 project(Vec3 p) const {
    const auto& m = to_raster_.m;
    float w = p.x * m[3] + p.y * m[7] + p.z * m[11] + m[15];
    return {(p.x * m[0] + p.y * m[4] + p.z * m[8] + m[12]) / w,
            (p.x * m[1] + p.y * m[5] + p.z * m[9] + m[13]) / w};
  }
  /// The point at depth z that project() sends to a place of the image.
  Vec3 unproject(Vec2 raster, float z) const {
    const auto& m = to_raster_.m;
    float w = z * m[11] + m[15], x = raster.x * w - z * m[8] - m[12], y = raster.y * w - z * m[9] - m[13];
    float determinant = m[0] * m[5] - m[1] * m[4];
    return {(x * m[5] - y * m[4]) / determinant, (y * m[0] - x * m[1]) / determinant, z};
  }
  /// Pixels that a length of 1 at depth z takes when it faces the eye: the mean of both directions.
  float pixels_per_unit(float z) const {
    const auto& m = to_raster_.m;
    return std::sqrt(std::abs(m[0] * m[5] - m[1] * m[4])) / std::abs(z * m[11] + m[15]);
  }
  bool perspective() const { return perspective_; }
  /// The eye: the origin (also for orthographic cameras, where I is (0,0,z)).
  Vec3 incident(Vec3 p) const { return perspective_ ? p : Vec3(0, 0, p.z); }
  /// Whether what is out of focus is blurred.
  bool has_lens() const { return lens_radius_ > 0; }
  /// A point at depth z, seen through `lens` of the unit disk, moves by lens_to_raster(lens) * defocus(z).
  float defocus(float z) const { return 1 / focal_distance_ - 1 / z; }
  Vec2 lens_to_raster(Vec2 lens) const {
    const auto& m = to_raster_.m;
    return Vec2(lens.x * m[0] + lens.y * m[4], lens.x * m[1] + lens.y * m[5]) * lens_radius_;
  }
  /// The farthest a point between two depths moves in x and y.
  Vec2 blur(float znear, float zfar) const;
  float near_plane() const { return near_; }
  float far_plane() const { return far_; }
  /// The pixels to render: crop window within the frame.
  PixelRect crop() const { return crop_; }

private:
  Matrix4 to_screen_, to_ndc_, to_raster_;
  bool perspective_;
  float near_, far_;
  float lens_radius_ = 0, focal_distance_ = kInfinity;
  PixelRect crop_;
};

} // namespace render
