// Making maps. The axes of cube faces: RISpec 3.2, appendix on environment maps, seen from the middle.
#include "render/oiio/functions.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

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
  std::string temporary = name + "." + std::to_string(::getpid()) + ".part";
  std::error_code error;
  if (!algo::make_texture(mode, image, temporary, config)) {
    std::string why = image.has_error() ? image.geterror() : OIIO::geterror();
    fs::remove(temporary, error);
    return "cannot make \"" + name + "\": " + reason(why);
  }
  fs::rename(temporary, name, error);
  if (!error) return {};
  std::string why = error.message();
  fs::remove(temporary, error);
  return "cannot make \"" + name + "\": " + why;
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

/// The colour in a direction: of the face it goes through, blended between pixels.
void cube_pixel(const std::array<ImageBuf, 6>& faces, const float (&d)[3], float half_width, float* out) {
  size_t face = 0;
  for (size_t i = 1; i < 6; ++i)
    if (dot(d, kFaces[i].forward) > dot(d, kFaces[face].forward)) face = i;
  const Face& f = kFaces[face];
  const OIIO::ImageSpec& spec = faces[face].spec();
  float depth = dot(d, f.forward) * half_width;
  float s = 0.5f + 0.5f * dot(d, f.right) / depth, t = 0.5f - 0.5f * dot(d, f.up) / depth;
  faces[face].interppixel(s * static_cast<float>(spec.width) + static_cast<float>(spec.x),
                          t * static_cast<float>(spec.height) + static_cast<float>(spec.y), out,
                          ImageBuf::WrapClamp);
}

} // namespace

std::string make_texture(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  return make_plain(algo::MakeTxTexture, image, texture, settings);
}

std::string make_latlong(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  return make_plain(algo::MakeTxEnvLatl, image, texture, settings);
}

std::string make_cube_environment(const std::array<std::string, 6>& names, const std::string& texture,
                                  float fov, const MakeSettings& settings) {
  std::array<ImageBuf, 6> faces;
  int size = 1, channels = 3;
  for (size_t i = 0; i < 6; ++i) {
    if (std::string why = read(names[i], faces[i]); !why.empty()) return why;
    size = std::max({size, faces[i].spec().width, faces[i].spec().height});
    channels = i == 0 ? faces[i].nchannels() : std::min(channels, faces[i].nchannels());
  }
  constexpr float kPi = std::numbers::pi_v<float>;
  float half_width = std::tan(fov * kPi / 360);
  // As many pixels round the equator as the four faces have there.
  OIIO::ImageSpec spec(4 * size, 2 * size, channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames = faces[0].spec().channelnames;
  spec.channelnames.resize(static_cast<size_t>(channels));
  ImageBuf whole(spec);
  int most = 0;
  for (const ImageBuf& f : faces)
    most = std::max(most, f.nchannels());
  std::vector<float> pixel(static_cast<size_t>(most));
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) {
      float longitude = (static_cast<float>(x) + 0.5f) / static_cast<float>(spec.width) * 2 * kPi;
      float latitude = (0.5f - (static_cast<float>(y) + 0.5f) / static_cast<float>(spec.height)) * kPi;
      const float d[3] = {std::cos(longitude) * std::cos(latitude), std::sin(longitude) * std::cos(latitude),
                          std::sin(latitude)};
      cube_pixel(faces, d, half_width, pixel.data());
      whole.setpixel(x, y, pixel.data());
    }
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
