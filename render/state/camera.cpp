// Camera matrices from the options.
#include "render/state/camera.h"

#include "render/state/transforms.h"

#include <cmath>

namespace render {

namespace {

/// x, y to the image plane, z to 0..1 between the clipping planes (RISpec 3.2, 4.1.1).
Matrix4 projection_matrix(const Options& o) {
  float n = o.near_plane;
  // f/(f-n) and 1/(f-n) without overflow for far planes at infinity.
  float ratio = o.far_plane > 1e20f ? 1.0f : o.far_plane / (o.far_plane - n);
  float scale = 1 / (o.far_plane - n);
  Matrix4 m;
  if (o.projection == ProjectionKind::kOrthographic) {
    m(2, 2) = scale;
    m(3, 2) = -n * scale;
    return m;
  }
  float t = std::tan(radians(o.fov) / 2);
  m(0, 0) = m(1, 1) = 1 / t;
  m(2, 2) = ratio;
  m(2, 3) = 1;
  m(3, 2) = -n * ratio;
  m(3, 3) = 0;
  return m;
}

/// Pixels from ceil(res * min) to ceil(res * max - 1), clamped to the frame (RISpec 3.2, 4.1.2). A little
/// less than a pixel's thousandth is forgiven, so that 0.3 of 90 pixels is 27 although the nearest float to
/// 0.3 is larger.
void crop_range(int res, float low, float high, int& begin, int& end) {
  constexpr float kSlack = 1e-3f;
  auto size = static_cast<float>(res);
  auto edge = [&](float x) { return static_cast<int>(std::clamp(std::ceil(size * x - kSlack), 0.0f, size)); };
  begin = edge(low);
  end = edge(high); // ceil(x - 1) + 1 is ceil(x)
}

} // namespace

Camera::Camera(const Options& o)
    : perspective_(o.projection == ProjectionKind::kPerspective), near_(o.near_plane), far_(o.far_plane) {
  to_screen_ = projection_matrix(o) * o.screen_transform;
  auto [left, right, bottom, top] = o.window();
  to_ndc_ = to_screen_ * translation({-left, -top, 0}) * scaling({1 / (right - left), 1 / (bottom - top), 1});
  to_raster_ = to_ndc_ * scaling({static_cast<float>(o.xres), static_cast<float>(o.yres), 1});
  if (perspective_ && o.fstop < kInfinity) {
    lens_radius_ = 0.5f * o.focal_length / o.fstop;
    focal_distance_ = o.focal_distance;
    // Files that want no lens also say so by a huge fstop or a tiny focal length.
    constexpr float kVisible = 1.0f / 64; // pixels
    Vec2 most = blur(near_, kInfinity);
    if (std::max(most.x, most.y) < kVisible) lens_radius_ = 0;
  }
  crop_range(o.xres, o.crop[0], o.crop[1], crop_.x0, crop_.x1);
  crop_range(o.yres, o.crop[2], o.crop[3], crop_.y0, crop_.y1);
}

Vec2 Camera::blur(float znear, float zfar) const {
  if (!has_lens()) return Vec2(0.0f);
  const auto& m = to_raster_.m;
  float most = std::max(std::abs(defocus(znear)), std::abs(defocus(zfar))) * lens_radius_;
  return {std::hypot(m[0], m[4]) * most, std::hypot(m[1], m[5]) * most};
}

} // namespace render
