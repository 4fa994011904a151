// The axes of cube faces: RISpec 3.2, appendix on environment maps, seen from the middle.
#include "render/texture/cube_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

struct Face {
  float forward[3], up[3], right[3];
};
constexpr Face kFaces[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                            {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}};

float dot(const float (&a)[3], const float (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Places on a cube, each on a face: to the right of its middle and up, -1 to 1 in a face of 90 degrees.
struct CubePlaces {
  std::vector<int> face;
  std::vector<float> right, up;

  explicit CubePlaces(size_t count) : face(count), right(count), up(count) {}
};

/// Where directions go through: the face they are nearest to. `x`, `y`: one each, in vectors.
void find_places(const float* __restrict x, const float* __restrict y, float z, CubePlaces& out) {
  int* __restrict face = out.face.data();
  float* __restrict right = out.right.data(), * __restrict up = out.up.data();
  const size_t count = out.face.size();
  for (size_t i = 0; i < count; ++i) {
    const float d[3] = {x[i], y[i], z};
    float most = 0, r = 0, u = 0;
    int found = 0;
#pragma GCC unroll 6 // else there are no vectors
    for (int f = 0; f < 6; ++f) {
      const float along = dot(d, kFaces[f].forward);
      const bool nearer = along > most;
      r = nearer ? dot(d, kFaces[f].right) : r;
      u = nearer ? dot(d, kFaces[f].up) : u;
      found = nearer ? f : found;
      most = nearer ? along : most;
    }
    face[i] = found;
    right[i] = r / most;
    up[i] = u / most;
  }
}

class Cube {
public:
  Cube(const std::array<FloatImage, 6>& faces, float fov)
      : faces_(faces), half_width_(std::tan(fov * kPi / 360)) {}

  /// The colours at places, blended between pixels.
  void find_pixels(const CubePlaces& places, float* out) const {
    for (size_t i = 0; i < places.face.size(); ++i, out += faces_[0].channels) {
      const auto face = static_cast<size_t>(places.face[i]);
      const FloatImage& image = faces_[face];
      const float at_x = column(image, places.right[i]) + 0.5f, at_y = row(image, places.up[i]) + 0.5f;
      const int x = static_cast<int>(at_x) - 1, y = static_cast<int>(at_y) - 1;
      const float wx = at_x - static_cast<float>(x + 1), wy = at_y - static_cast<float>(y + 1);
      const float weights[4] = {(1 - wx) * (1 - wy), wx * (1 - wy), (1 - wx) * wy, wx * wy};
      const float* pixels[4];
      if (x >= 0 && y >= 0 && x + 1 < image.width && y + 1 < image.height) {
        pixels[0] = image.row(y) + static_cast<size_t>(x) * image.channels;
        pixels[1] = pixels[0] + image.channels;
        pixels[2] = pixels[0] + image.row_size();
        pixels[3] = pixels[2] + image.channels;
      } else {
        for (int k = 0; k < 4; ++k)
          pixels[k] = find_pixel(face, x + k % 2, y + k / 2);
      }
      for (size_t c = 0; c < image.channels; ++c)
        out[c] = weights[0] * pixels[0][c] + weights[1] * pixels[1][c] + weights[2] * pixels[2][c] +
                 weights[3] * pixels[3][c];
    }
  }

private:
  /// In pixels from the upper left corner.
  float column(const FloatImage& image, float right) const {
    return (0.5f + 0.5f * right / half_width_) * static_cast<float>(image.width);
  }
  float row(const FloatImage& image, float up) const {
    return (0.5f - 0.5f * up / half_width_) * static_cast<float>(image.height);
  }

  /// A pixel of a face. Of those just beyond its sides: the nearest pixel of the neighbour that has it, so
  /// that faces of exactly 90 degrees go over into each other.
  const float* find_pixel(size_t face, int x, int y) const {
    const FloatImage* image = &faces_[face];
    if (x < 0 || y < 0 || x >= image->width || y >= image->height) {
      const Face& f = kFaces[face];
      const float right =
          ((static_cast<float>(x) + 0.5f) / static_cast<float>(image->width) * 2 - 1) * half_width_;
      const float up =
          (1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(image->height) * 2) * half_width_;
      float d[3];
      for (int i = 0; i < 3; ++i)
        d[i] = f.forward[i] + right * f.right[i] + up * f.up[i];
      CubePlaces there(1);
      find_places(&d[0], &d[1], d[2], there);
      image = &faces_[static_cast<size_t>(there.face[0])];
      x = static_cast<int>(column(*image, there.right[0]));
      y = static_cast<int>(row(*image, there.up[0]));
    }
    return image->row(std::clamp(y, 0, image->height - 1)) +
           static_cast<size_t>(std::clamp(x, 0, image->width - 1)) * image->channels;
  }

  const std::array<FloatImage, 6>& faces_;
  float half_width_; ///< of a face at distance 1
};

} // namespace

FloatImage latlong_of_cube(const std::array<FloatImage, 6>& faces, float fov) {
  int size = 1;
  for (const FloatImage& face : faces)
    size = std::max({size, face.width, face.height});
  FloatImage out(4 * size, 2 * size, faces[0].channels);
  const Cube cube(faces, fov);
  const auto columns = static_cast<size_t>(out.width);
  std::vector<float> cosines(columns), sines(columns), x(columns), y(columns);
  for (size_t i = 0; i < columns; ++i) {
    const float longitude = (static_cast<float>(i) + 0.5f) / static_cast<float>(out.width) * 2 * kPi;
    cosines[i] = std::cos(longitude);
    sines[i] = std::sin(longitude);
  }
  CubePlaces places(columns);
  for (int row = 0; row < out.height; ++row) {
    const float latitude = (0.5f - (static_cast<float>(row) + 0.5f) / static_cast<float>(out.height)) * kPi;
    const float flat = std::cos(latitude);
    for (size_t i = 0; i < columns; ++i) {
      x[i] = cosines[i] * flat;
      y[i] = sines[i] * flat;
    }
    find_places(x.data(), y.data(), std::sin(latitude), places);
    cube.find_pixels(places, out.row(row));
  }
  return out;
}

} // namespace render
