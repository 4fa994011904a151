// From finished pixels to image files: what each channel becomes, and where.
#include "render/display/output.h"

#include "render/display/channels.h"
#include "render/display/quantize.h"
#include "render/state/camera.h"
#include "render/state/transforms.h"
#include "render/texture/image_file.h"
#include "render/texture/image_module.h"

#include <fmt/format.h>

#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>
#include <unistd.h>

namespace render {

namespace {

namespace fs = std::filesystem;

struct Format {
  std::string plugin, extension;
};

/// The format of a Display type. Interactive types of other renderers become files.
slvm::Result<Format> choose_format(const DisplayRequest& d) {
  std::string extension = fs::path(d.name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  auto known = [](const std::string& name) {
    if (name == "tif" || name == "tiff" || name == "png") return true;
    const ImageModule& module = image_module();
    return module.problem.empty() && module.knows_format(name);
  };
  const std::string& t = d.type;
  if (t == "tiff" || t == "tif") return Format{"tiff", "tif"};
  if (t == "png") return Format{"png", "png"};
  if (t == "openexr" || t == "exr") return Format{"openexr", "exr"};
  if (t == "zfile" || t == "shadow") return Format{"tiff", "z"};
  if (t == "file" || t == "framebuffer" || t == "it") {
    if (!extension.empty() && known(extension))
      return Format{extension == "tif" ? "tiff" : extension, extension};
    return Format{"tiff", "tif"};
  }
  if (known(t)) return Format{t, t};
  return slvm::Error{
      fmt::format("unknown type \"{}\"; expected \"tiff\", \"png\", \"openexr\", \"file\", \"null\" or "
                  "another format of OpenImageIO",
                  t)};
}

/// What one channel becomes: quantised integers or floats.
PixelType pixel_type(const Quantization& q, const std::string& plugin) {
  bool integers_only = plugin == "png" || plugin == "jpeg" || plugin == "bmp" || plugin == "targa";
  bool floats_only = plugin == "openexr" || plugin == "hdr";
  if (floats_only || (q.is_float() && !integers_only)) return PixelType::kFloat;
  if (q.is_float()) return PixelType::kShort;
  if (q.min >= 0 && q.max <= 255) return PixelType::kByte;
  if (q.min >= 0 && q.max <= 65535) return PixelType::kShort;
  return PixelType::kFloat;
}

class Writer {
public:
  Writer(const Scene& scene, const Image& image, const std::vector<AovChannel>& aovs)
      : scene_(scene), options_(scene.options), image_(image), aovs_(aovs) {}

  /// The name of the file, or why there is none.
  slvm::Result<std::string> write(const DisplayRequest& d);

private:
  void describe(ImageFile& file, const std::vector<FileChannel>& channels) const;
  float value(const FileChannel& channel, const DisplaySettings& settings, int x, int y) const;
  template <class T>
  std::vector<std::byte> pack(const std::vector<FileChannel>& channels, const DisplaySettings& settings,
                              const Quantization& color, const Quantization& depth) const;

  const Scene& scene_;
  const Options& options_;
  const Image& image_;
  const std::vector<AovChannel>& aovs_;
};

void Writer::describe(ImageFile& file, const std::vector<FileChannel>& channels) const {
  file.width = image_.rect.width();
  file.height = image_.rect.height();
  file.x = image_.rect.x0;
  file.y = image_.rect.y0;
  file.full_width = options_.xres * (options_.subpixel ? options_.xsamples : 1);
  file.full_height = options_.yres * (options_.subpixel ? options_.ysamples : 1);
  for (const FileChannel& channel : channels)
    file.channels.push_back(channel.name);
  file.pixel_aspect = options_.pixel_aspect;
  Camera camera(options_);
  // To the picture, x from -1 to 1 left to right, y from -1 to 1 upwards, as textureinfo() and shadow() want
  // it.
  Matrix4 to_screen =
      scene_.world_to_camera * camera.to_ndc() * translation({-0.5f, -0.5f, 0}) * scaling({2, -2, 1});
  std::copy_n(scene_.world_to_camera.m.data(), 16, file.world_to_camera.begin());
  std::copy_n(to_screen.m.data(), 16, file.world_to_screen.begin());
}

/// The frame's exposure is in the standard channels already; the others get theirs here.
float Writer::value(const FileChannel& channel, const DisplaySettings& settings, int x, int y) const {
  float v = image_.pixel(x, y)[channel.source];
  bool color = channel.group == FileChannel::Group::kColor && channel.name != "A";
  if (!color || channel.source < Image::kAov) return v;
  auto [gain, gamma] = settings.exposure.value_or(std::array{options_.gain, options_.gamma});
  return exposed(v, gain, gamma);
}

template <class T>
std::vector<std::byte> Writer::pack(const std::vector<FileChannel>& channels, const DisplaySettings& settings,
                                    const Quantization& color, const Quantization& depth) const {
  const PixelRect& r = image_.rect;
  std::vector<std::byte> out(static_cast<size_t>(r.width()) * static_cast<size_t>(r.height()) *
                             channels.size() * sizeof(T));
  std::byte* at = out.data();
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x)
      for (const FileChannel& c : channels) {
        float v = value(c, settings, x, y);
        const Quantization& q = c.group == FileChannel::Group::kDepth ? depth : color;
        T value;
        if constexpr (std::is_same_v<T, float>)
          value = q.is_float() ? v : static_cast<T>(quantize(v, q, x, y, c.source));
        else
          value = static_cast<T>(quantize(v, q, x, y, c.source));
        std::memcpy(at, &value, sizeof(T));
        at += sizeof(T);
      }
  return out;
}

/// Empty: display_aovs() has reported that there is nothing to write.
slvm::Result<std::string> Writer::write(const DisplayRequest& d) {
  std::vector<FileChannel> channels = file_channels(options_, d, aovs_);
  if (channels.empty()) return std::string();
  auto settings = display_settings(d);
  auto format = choose_format(d);
  if (!format) return slvm::Error{format.error()};
  std::string name = d.name;
  if (fs::path(name).extension().empty()) name += "." + format->extension;

  // Variables of shaders are floats unless the display says otherwise.
  bool is_depth = channels[0].group == FileChannel::Group::kDepth;
  Quantization color = channels[0].group == FileChannel::Group::kVariable ? options_.z : options_.rgba;
  Quantization depth = options_.z;
  for (Quantization* q : {&color, &depth}) {
    if (settings->quantize) *q = *settings->quantize;
    if (settings->dither) q->dither = *settings->dither;
  }
  PixelType type = pixel_type(is_depth ? depth : color, format->plugin);
  if (type == PixelType::kFloat && !color.set) color.one = 0;
  if (type == PixelType::kShort && color.is_float()) color = {65535, 0, 65535, color.dither, true, 0};
  if (type != PixelType::kFloat && depth.is_float()) depth = color;

  ImageFile file;
  describe(file, channels);
  file.format = format->plugin;
  file.type = type;
  if (auto it = d.params.find("compression"); it != d.params.end() && !it->second.strings.empty())
    file.compression = it->second.strings[0];
  if (type == PixelType::kByte)
    file.pixels = pack<uint8_t>(channels, *settings, color, depth);
  else if (type == PixelType::kShort)
    file.pixels = pack<uint16_t>(channels, *settings, color, depth);
  else
    file.pixels = pack<float>(channels, *settings, color, depth);

  file.path = fmt::format("{}.{}.part", name, ::getpid());
  std::string why = write_image_file(file);
  std::error_code error;
  if (why.empty()) {
    fs::rename(file.path, name, error);
    if (!error) return name;
    why = error.message();
  }
  fs::remove(file.path, error);
  return slvm::Error{fmt::format("cannot write \"{}\": {}", name, why)};
}

} // namespace

std::vector<std::string> write_displays(const Scene& scene, const Image& image,
                                        const std::vector<AovChannel>& aovs, slvm::Diagnostics& diagnostics) {
  std::vector<std::string> written;
  assert(aovs.empty() || image.channels == Image::kAov + aovs.back().first + aovs.back().components);
  Writer writer(scene, image, aovs);
  for (const DisplayRequest& d : scene.options.displays) {
    if (d.type == "null") continue;
    auto name = writer.write(d);
    if (name && !name->empty())
      written.push_back(*name);
    else if (!name)
      diagnostics.error(d.where, "Display: " + name.error());
  }
  return written;
}

} // namespace render
