// The axes of cube faces: RISpec 3.2, appendix on environment maps, seen from the middle.
#include "render/texture/cube_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// A place of a face, in pixels from its upper left corner.
struct CubePlace {
  size_t face = 0;
  float x = 0, y = 0;
};

class Cube {
public:
  Cube(const std::array<FloatImage, 6>& faces, float fov)
      : faces_(faces), half_width_(std::tan(fov * kPi / 360)) {}

  /// Adds the colour in a direction: of the face it goes through, blended between pixels.
  void add_pixel(const float (&d)[3], float* out) const {
    const CubePlace at = find_place(d);
    const FloatImage& image = faces_[at.face];
    const float left = std::floor(at.x - 0.5f), top = std::floor(at.y - 0.5f);
    const float wx = at.x - 0.5f - left, wy = at.y - 0.5f - top;
    const int x = static_cast<int>(left), y = static_cast<int>(top);
    const float weights[4] = {(1 - wx) * (1 - wy), wx * (1 - wy), (1 - wx) * wy, wx * wy};
    const float* pixels[4];
    if (x >= 0 && y >= 0 && x + 1 < image.width && y + 1 < image.height) {
      pixels[0] = image.row(y) + static_cast<size_t>(x) * image.channels;
      pixels[1] = pixels[0] + image.channels;
      pixels[2] = pixels[0] + image.row_size();
      pixels[3] = pixels[2] + image.channels;
    } else {
      for (int k = 0; k < 4; ++k)
        pixels[k] = find_pixel(at.face, x + k % 2, y + k / 2);
    }
    for (int k = 0; k < 4; ++k)
      for (size_t c = 0; c < image.channels; ++c)
        out[c] += weights[k] * pixels[k][c];
  }

private:
  CubePlace find_place(const float (&d)[3]) const {
    CubePlace out;
    float most = d[0];
    for (size_t i = 1; i < 6; ++i) // the faces stand in pairs along x, y, z
      if (const float along = i % 2 ? -d[i / 2] : d[i / 2]; along > most) out.face = i, most = along;
    const Face& f = kFaces[out.face];
    const float half_depth = 0.5f / (most * half_width_);
    out.x = (0.5f + dot(d, f.right) * half_depth) * static_cast<float>(faces_[out.face].width);
    out.y = (0.5f - dot(d, f.up) * half_depth) * static_cast<float>(faces_[out.face].height);
    return out;
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
      const CubePlace there = find_place(d);
      image = &faces_[there.face];
      x = static_cast<int>(there.x);
      y = static_cast<int>(there.y);
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
  std::vector<std::array<float, 2>> meridians;
  for (int x = 0; x < out.width; ++x) {
    const float longitude = (static_cast<float>(x) + 0.5f) / static_cast<float>(out.width) * 2 * kPi;
    meridians.push_back({std::cos(longitude), std::sin(longitude)});
  }
  for (int y = 0; y < out.height; ++y) {
    const float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(out.height)) * kPi;
    const float flat = std::cos(latitude), up = std::sin(latitude);
    float* pixel = out.row(y);
    for (const auto& [cosine, sine] : meridians) {
      cube.add_pixel({cosine * flat, sine * flat, up}, pixel);
      pixel += out.channels;
    }
  }
  return out;
}

} // namespace render
