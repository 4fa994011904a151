// Making maps. The axes of cube faces: RISpec 3.2, appendix on environment maps, seen from the middle.
#include "render/oiio/blur.h"
#include "render/oiio/functions.h"

#include "slvm/support/whole_file.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace render::oiio {

namespace {

namespace fs = std::filesystem;
using OIIO::ImageBuf;
namespace algo = OIIO::ImageBufAlgo;

/// The line of OpenImageIO's message, without its line end.
std::string reason(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (text.ends_with(' '))
    text.pop_back();
  return text.empty() ? "unknown reason" : text;
}

OIIO::ImageSpec configuration(const MakeSettings& s) {
  OIIO::ImageSpec config;
  config.attribute("maketx:filtername", s.filter);
  config.attribute("wrapmodes", s.swrap + "," + s.twrap);
  return config;
}

/// Writes under a temporary name first.
std::string make(algo::MakeTextureMode mode, const ImageBuf& image, const std::string& name,
                 OIIO::ImageSpec config) {
  std::string extension = fs::path(name).extension().string();
  config.attribute("maketx:fileformatname", extension == ".exr" ? "openexr" : "tiff");
  slvm::WholeFile file(name);
  std::string why;
  if (algo::make_texture(mode, image, file.temporary(), config))
    why = file.commit();
  else
    why = reason(image.has_error() ? image.geterror() : OIIO::geterror());
  return why.empty() ? why : "cannot make \"" + name + "\": " + why;
}

/// Not by ImageBuf itself: that remembers files by name, and a scene may have written the image anew.
std::string read(const std::string& name, ImageBuf& image) {
  auto failed = [&](const std::string& why) { return "cannot read \"" + name + "\": " + reason(why); };
  auto in = OIIO::ImageInput::open(name);
  if (!in) return failed(OIIO::geterror());
  OIIO::ImageSpec spec = in->spec();
  spec.set_format(OIIO::TypeDesc::FLOAT);
  spec.channelformats.clear();
  spec.tile_width = spec.tile_height = spec.tile_depth = 0;
  image.reset(spec);
  if (in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.localpixels())) return {};
  return failed(in->geterror());
}

std::string make_plain(algo::MakeTextureMode mode, const std::string& name, const std::string& map,
                       const MakeSettings& settings) {
  ImageBuf image;
  if (std::string why = read(name, image); !why.empty()) return why;
  if (mode == algo::MakeTxEnvLatl)
    blur_sphere(image, settings);
  else
    blur(image, settings);
  return make(mode, image, map, configuration(settings));
}

struct Face {
  float forward[3], up[3], right[3];
};
constexpr Face kFaces[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                            {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}};

float dot(const float (&a)[3], const float (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Cube {
  std::array<ImageBuf, 6> faces;
  float half_width = 1; ///< of a face at distance 1
  int channels = 3;     ///< that all faces have
};

/// A place of a face, in pixels from its upper left corner.
struct CubePlace {
  size_t face = 0;
  float x = 0, y = 0;
};

CubePlace find_place(const Cube& cube, const float (&d)[3]) {
  CubePlace out;
  for (size_t i = 1; i < 6; ++i)
    if (dot(d, kFaces[i].forward) > dot(d, kFaces[out.face].forward)) out.face = i;
  const Face& f = kFaces[out.face];
  const OIIO::ImageSpec& spec = cube.faces[out.face].spec();
  float depth = dot(d, f.forward) * cube.half_width;
  out.x = (0.5f + 0.5f * dot(d, f.right) / depth) * static_cast<float>(spec.width);
  out.y = (0.5f - 0.5f * dot(d, f.up) / depth) * static_cast<float>(spec.height);
  return out;
}

/// A pixel of a face. Of those just beyond its sides: the nearest pixel of the neighbour that has it, so that
/// faces of exactly 90 degrees go over into each other.
void face_pixel(const Cube& cube, size_t face, int x, int y, float* out) {
  const OIIO::ImageSpec& spec = cube.faces[face].spec();
  if (x < 0 || y < 0 || x >= spec.width || y >= spec.height) {
    const Face& f = kFaces[face];
    float right = ((static_cast<float>(x) + 0.5f) / static_cast<float>(spec.width) * 2 - 1) * cube.half_width;
    float up = (1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(spec.height) * 2) * cube.half_width;
    float d[3];
    for (int i = 0; i < 3; ++i)
      d[i] = f.forward[i] + right * f.right[i] + up * f.up[i];
    CubePlace there = find_place(cube, d);
    face = there.face;
    x = static_cast<int>(there.x);
    y = static_cast<int>(there.y);
  }
  const OIIO::ImageSpec& own = cube.faces[face].spec();
  cube.faces[face].getpixel(std::clamp(x, 0, own.width - 1) + own.x, std::clamp(y, 0, own.height - 1) + own.y,
                            0, out, cube.channels);
}

/// The colour in a direction: of the face it goes through, blended between pixels.
void cube_pixel(const Cube& cube, const float (&d)[3], std::vector<float>& out) {
  CubePlace at = find_place(cube, d);
  float x = std::floor(at.x - 0.5f), y = std::floor(at.y - 0.5f);
  float wx = at.x - 0.5f - x, wy = at.y - 0.5f - y;
  std::vector<float> pixel(out.size());
  std::fill(out.begin(), out.end(), 0.0f);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      face_pixel(cube, at.face, static_cast<int>(x) + i, static_cast<int>(y) + j, pixel.data());
      float weight = (i == 0 ? 1 - wx : wx) * (j == 0 ? 1 - wy : wy);
      for (size_t c = 0; c < out.size(); ++c)
        out[c] += weight * pixel[c];
    }
}

} // namespace

std::string make_texture(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  return make_plain(algo::MakeTxTexture, image, texture, settings);
}

/// The first channel: heights have but one.
std::string make_bump(const std::string& name, const std::string& bump, const MakeSettings& settings) {
  ImageBuf image;
  if (std::string why = read(name, image); !why.empty()) return why;
  ImageBuf heights = algo::channels(image, 1, {0});
  blur(heights, settings);
  return make(algo::MakeTxTexture, heights, bump, configuration(settings));
}

std::string make_latlong(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  return make_plain(algo::MakeTxEnvLatl, image, texture, settings);
}

std::string make_cube_environment(const std::array<std::string, 6>& names, const std::string& texture,
                                  float fov, const MakeSettings& settings) {
  Cube cube;
  int size = 1;
  for (size_t i = 0; i < 6; ++i) {
    ImageBuf& face = cube.faces[i];
    if (std::string why = read(names[i], face); !why.empty()) return why;
    size = std::max({size, face.spec().width, face.spec().height});
    cube.channels = i == 0 ? face.nchannels() : std::min(cube.channels, face.nchannels());
  }
  constexpr float kPi = std::numbers::pi_v<float>;
  cube.half_width = std::tan(fov * kPi / 360);
  // As many pixels round the equator as the four faces have there.
  OIIO::ImageSpec spec(4 * size, 2 * size, cube.channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames = cube.faces[0].spec().channelnames;
  spec.channelnames.resize(static_cast<size_t>(cube.channels));
  ImageBuf whole(spec);
  std::vector<float> pixel(static_cast<size_t>(cube.channels));
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) {
      float longitude = (static_cast<float>(x) + 0.5f) / static_cast<float>(spec.width) * 2 * kPi;
      float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(spec.height)) * kPi;
      const float d[3] = {std::cos(longitude) * std::cos(latitude), std::sin(longitude) * std::cos(latitude),
                          std::sin(latitude)};
      cube_pixel(cube, d, pixel);
      whole.setpixel(x, y, pixel.data());
    }
  blur_sphere(whole, settings);
  return make(algo::MakeTxEnvLatl, whole, texture, configuration(settings));
}

std::string make_shadow(const std::string& depths, const std::string& shadow) {
  ImageBuf image;
  if (std::string why = read(depths, image); !why.empty()) return why;
  for (const char* name : {"worldtocamera", "worldtoscreen"})
    if (!image.spec().find_attribute(name, OIIO::TypeMatrix))
      return "\"" + depths + "\" is no depth image of a render: it lacks the matrix " + name;
  ImageBuf z = image;
  if (int channel = image.spec().z_channel; channel > 0) z = algo::channels(image, 1, {channel});
  return make(algo::MakeTxShadow, z, shadow, {});
}

} // namespace render::oiio
