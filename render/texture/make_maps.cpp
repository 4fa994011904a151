// From the files of images to those of maps. A map stores the type of numbers its image has, but floats when
// steps of the image's integers would show: where it was softened, and in heights, whose differences count.
#include "render/texture/make_maps.h"

#include "render/texture/blur.h"
#include "render/texture/cube_map.h"
#include "render/texture/depth_image.h"
#include "render/texture/image_file.h"
#include "render/texture/open_texture.h"
#include "slvm/support/whole_file.h"

#include <algorithm>
#include <filesystem>

namespace render {

namespace {

/// An image on its way to a map.
struct Source {
  FloatImage image;
  TextureHeader header;

  std::string read(const std::string& name) {
    std::string problem;
    if (auto reader = open_texture(name, problem)) {
      std::atomic<long long> memory{0};
      const TextureImage texture(std::move(reader), memory);
      header = texture.header();
      if (!texture.numbers(0, image)) problem = texture.problem();
    }
    return problem.empty() ? problem : "cannot read \"" + name + "\": " + problem;
  }

  /// The first ones only.
  void keep_channels(size_t count) {
    if (count >= image.channels) return;
    const FloatImage all = std::move(image);
    image = FloatImage(all.width, all.height, count);
    for (size_t from = 0, to = 0; to < image.numbers.size(); from += all.channels, to += count)
      std::copy_n(all.numbers.begin() + static_cast<std::ptrdiff_t>(from), count,
                  image.numbers.begin() + static_cast<std::ptrdiff_t>(to));
  }
};

bool softens(const MakeSettings& s) {
  return widens(s.filter, s.swidth) || widens(s.filter, s.twidth);
}

std::vector<std::byte> stored(const FloatImage& image, PixelType type) {
  std::vector<std::byte> out(image.numbers.size() * bytes_of(type));
  from_floats(image.numbers, type, out.data());
  return out;
}

/// As they are usually called.
std::vector<std::string> channel_names(size_t count) {
  if (count == 1) return {"Y"};
  if (count == 2) return {"Y", "A"};
  std::vector<std::string> out{"R", "G", "B"};
  for (size_t i = 3; i < count; ++i)
    out.push_back(i == 3 ? "A" : "channel" + std::to_string(i));
  return out;
}

/// Writes under a temporary name first. `image`: softened, the first level.
std::string write(const FloatImage& image, const TextureHeader& header, const std::string& format,
                  const std::string& name, const MakeSettings& settings) {
  slvm::WholeFile whole(name);
  ImageFile file;
  file.path = whole.temporary();
  file.format = std::filesystem::path(name).extension() == ".exr" ? "openexr" : "tiff";
  file.type = softens(settings) || file.format == "openexr" ? PixelType::kFloat : header.type;
  file.width = file.full_width = image.width;
  file.height = file.full_height = image.height;
  file.channels = channel_names(image.channels);
  file.texture_format = format;
  file.wraps = name_of(settings.swrap) + "," + name_of(settings.twrap);
  if (header.world_to_camera.size() == 16)
    std::copy_n(header.world_to_camera.begin(), 16, file.world_to_camera.begin());
  if (header.world_to_screen.size() == 16)
    std::copy_n(header.world_to_screen.begin(), 16, file.world_to_screen.begin());
  file.pixels = stored(image, file.type);
  const LevelFilter filter{settings.filter, settings.swrap, settings.twrap, format == "LatLong Environment"};
  for (FloatImage level = image; level.width > 1 || level.height > 1;) {
    level = half_of(level, filter);
    file.levels.push_back(stored(level, file.type));
  }
  std::string why = write_image_file(file);
  if (why.empty()) why = whole.commit();
  return why.empty() ? why : "cannot make \"" + name + "\": " + why;
}

std::string write_latlong(FloatImage& image, const TextureHeader& header, const std::string& name,
                          const MakeSettings& settings) {
  blur_sphere(image, settings);
  return write(image, header, "LatLong Environment", name, settings);
}

std::string write_texture(FloatImage& image, const TextureHeader& header, const std::string& name,
                          const MakeSettings& settings) {
  blur(image, settings);
  return write(image, header, "Plain Texture", name, settings);
}

} // namespace

bool has_width(FilterKind filter) {
  return filter == FilterKind::kBox || filter == FilterKind::kTriangle || filter == FilterKind::kGaussian;
}

bool widens(FilterKind filter, float width) {
  return has_width(filter) && width > (filter == FilterKind::kBox ? 1.0f : 2.0f);
}

std::string make_texture(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  Source source;
  if (std::string why = source.read(image); !why.empty()) return why;
  return write_texture(source.image, source.header, texture, settings);
}

std::string make_bump(const std::string& image, const std::string& bump, const MakeSettings& settings) {
  Source source;
  if (std::string why = source.read(image); !why.empty()) return why;
  source.keep_channels(1);
  source.header.type = PixelType::kFloat;
  return write_texture(source.image, source.header, bump, settings);
}

std::string make_latlong(const std::string& image, const std::string& texture, const MakeSettings& settings) {
  Source source;
  if (std::string why = source.read(image); !why.empty()) return why;
  return write_latlong(source.image, source.header, texture, settings);
}

std::string make_cube_environment(const std::array<std::string, 6>& names, const std::string& texture,
                                  float fov, const MakeSettings& settings) {
  std::array<Source, 6> sources;
  TextureHeader header;
  size_t channels = std::numeric_limits<size_t>::max();
  for (size_t i = 0; i < 6; ++i) {
    if (std::string why = sources[i].read(names[i]); !why.empty()) return why;
    channels = std::min(channels, sources[i].image.channels);
    header.type = std::max(header.type, sources[i].header.type);
  }
  std::array<FloatImage, 6> faces;
  for (size_t i = 0; i < 6; ++i) {
    sources[i].keep_channels(channels);
    faces[i] = std::move(sources[i].image);
  }
  FloatImage whole = latlong_of_cube(faces, fov);
  return write_latlong(whole, header, texture, settings);
}

/// Lookups take the finest level only, so that no others are made.
std::string make_shadow(const std::string& depths, const std::string& shadow) {
  DepthImage image;
  if (std::string why = read_depth_image(depths, image); !why.empty())
    return "cannot read \"" + depths + "\": " + why;
  for (auto [matrix, name] :
       {std::pair(&image.world_to_camera, "worldtocamera"), {&image.world_to_screen, "worldtoscreen"}})
    if (matrix->size() != 16)
      return "\"" + depths + "\" is no depth image of a render: it lacks the matrix " + name;
  std::string why = write_depth_image(shadow, image, "Shadow");
  return why.empty() ? why : "cannot make \"" + shadow + "\": " + why;
}

} // namespace render
