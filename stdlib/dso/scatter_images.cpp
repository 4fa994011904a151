#include "stdlib/dso/scatter_images.h"

#include "slvm/support/tiff_open.h"
#include "slvm/support/tiff_pixels.h"
#include "stdlib/subsurface/scatter_map.h"

#include <fmt/format.h>

namespace subsurface_plugin {
namespace {

constexpr size_t kMostPixels = size_t{1} << 28;

struct Image {
  size_t width = 0, height = 0, channels = 0;
  std::vector<float> pixels; ///< row by row, channels side by side

  /// The first `wanted` channels.
  std::vector<float> first(size_t wanted) const {
    std::vector<float> out;
    out.reserve(width * height * wanted);
    for (size_t i = 0; i < width * height; ++i)
      out.insert(out.end(), &pixels[i * channels], &pixels[i * channels] + wanted);
    return out;
  }
};

slvm::Result<Image> read_image(const std::string& path, size_t channels) {
  std::string message;
  auto error = [&](const std::string& text) { return slvm::Error{fmt::format("{}: {}", path, text)}; };
  const slvm::TiffFile file = slvm::open_tiff(path, "r", message);
  if (!file) return error(message.empty() ? "it cannot be read" : message);
  TIFF* t = file.get();
  const slvm::TiffLayout layout(t);
  if (!layout.is_float())
    return error("a picture of a scatter map has 32-bit floats (Quantize \"rgba\" 0 0 0 0)");
  if (layout.channels < channels)
    return error(fmt::format("it has {} channels, {} are wanted", layout.channels, channels));
  Image image{layout.width, layout.height, layout.channels, {}};
  if (image.width * image.height == 0 || image.width * image.height > kMostPixels / layout.channels)
    return error(fmt::format("{} x {} pixels are too many or too few", layout.width, layout.height));
  image.pixels.resize(image.width * image.height * image.channels);
  if (!slvm::TiffPixels(t, layout).read(std::as_writable_bytes(std::span(image.pixels))))
    return error(message.empty() ? "it is damaged" : message);
  return image;
}

/// The file of one kind of values, P, N, A or F.
std::string path_of(const std::string& name, char kind) {
  const size_t dot = name.find('.', name.rfind('/') == name.npos ? 0 : name.rfind('/'));
  return name.substr(0, dot) + kind + (dot == name.npos ? "" : name.substr(dot));
}

constexpr char kKinds[] = {'P', 'N', 'A', 'F'};

} // namespace

slvm::Result<subsurface::PointCloud> read_scatter_map(const std::string& name) {
  if (name.ends_with(".ply")) return subsurface::read_point_cloud(name);
  Image images[4];
  constexpr size_t kChannels[] = {3, 3, 1, 1};
  const bool has_faces = static_cast<bool>(subsurface::stamp_of(path_of(name, 'F')));
  for (size_t i = 0; i < (has_faces ? 4 : 3); ++i) {
    const std::string path = path_of(name, kKinds[i]);
    auto image = read_image(path, kChannels[i]);
    if (!image) return slvm::Error{image.error()};
    images[i] = std::move(*image);
    if (images[i].width != images[0].width || images[i].height != images[0].height)
      return slvm::Error{fmt::format("{} has {} x {} pixels, {} {} x {}: they must come from one rendering",
                                     path, images[i].width, images[i].height, path_of(name, 'P'),
                                     images[0].width, images[0].height)};
  }
  return subsurface::cloud_of_scatter_images(images[0].width, images[0].height, images[0].first(3),
                                             images[1].first(3), images[2].first(1),
                                             has_faces ? images[3].first(1) : std::vector<float>());
}

std::vector<subsurface::FileStamp> stamps_of_scatter_map(const std::string& name) {
  std::vector<subsurface::FileStamp> stamps;
  auto add = [&](const std::string& path) {
    const auto stamp = subsurface::stamp_of(path);
    stamps.push_back(stamp ? *stamp : subsurface::FileStamp());
  };
  if (name.ends_with(".ply"))
    add(name);
  else
    for (char kind : kKinds)
      add(path_of(name, kind));
  return stamps;
}

} // namespace subsurface_plugin
