// Heights above a depth image.
#include "render/prims/blobby_ground.h"

#include <cmath>

namespace render {

namespace {

/// Depths from here on stand for nothing.
constexpr float kEmpty = 1e29f;

Matrix4 matrix_of(const std::vector<float>& numbers) {
  Matrix4 m;
  std::copy_n(numbers.begin(), 16, m.m.begin());
  return m;
}

} // namespace

BlobbyGround::BlobbyGround(DepthImage image, const Matrix4& object_to_world)
    : image_(std::move(image)), to_camera_(object_to_world * matrix_of(image_.world_to_camera)),
      to_screen_(object_to_world * matrix_of(image_.world_to_screen)) {}

double BlobbyGround::height(glm::dvec3 p) const {
  auto row = [&](const Matrix4& m, int c) {
    return p.x * static_cast<double>(m(0, c)) + p.y * static_cast<double>(m(1, c)) +
           p.z * static_cast<double>(m(2, c)) + static_cast<double>(m(3, c));
  };
  double w = row(to_screen_, 3);
  if (!(w > 0)) return kInfinity;
  // Screen x and y run from -1 to 1 over the image, y upwards.
  double x = 0.5 * (1 + row(to_screen_, 0) / w) * image_.width,
         y = 0.5 * (1 - row(to_screen_, 1) / w) * image_.height;
  if (!(x >= 0 && x <= image_.width && y >= 0 && y <= image_.height)) return kInfinity;
  auto cell = [](double at, int size, int& first, int& second) {
    double centre = std::clamp(at - 0.5, 0.0, size - 1.0);
    first = static_cast<int>(centre);
    second = std::min(first + 1, size - 1);
    return centre - first;
  };
  int i0, i1, j0, j1;
  double u = cell(x, image_.width, i0, i1), v = cell(y, image_.height, j0, j1);
  double depth = 0, weight = 0;
  auto add = [&](int i, int j, double part) {
    float d =
        image_.depth[static_cast<size_t>(j) * static_cast<size_t>(image_.width) + static_cast<size_t>(i)];
    if (!(d < kEmpty) || !(part > 0)) return;
    depth += part * static_cast<double>(d);
    weight += part;
  };
  add(i0, j0, (1 - u) * (1 - v));
  add(i1, j0, u * (1 - v));
  add(i0, j1, (1 - u) * v);
  add(i1, j1, u * v);
  // At a rim the pixels that show something decide as far as they reach.
  return weight >= 0.5 ? depth / weight - row(to_camera_, 2) : kInfinity;
}

double GroundProfile::at(double z) const {
  double a = reach, b = sharpness, c = peak, d = bulge;
  if (!(z < a)) return 0;
  constexpr double kClosest = 1e-6;
  z = std::max(z, kClosest);
  // 0 at 0 and 2 with two derivatives, 1 at 1.
  double r = z / c, bump = r > 0 && r < 2 ? (((6 - r) * r - 12) * r + 8) * r * r * r : 0;
  double e = z / a, ease = e * e * (3 - 2 * e);
  return (d * bump - b / z) * (1 - ease);
}

} // namespace render
