// Output through OpenImageIO.
#include "render/display/output.h"

#include "render/display/channels.h"
#include "render/display/quantize.h"
#include "render/state/camera.h"
#include "render/state/transforms.h"

#include <OpenImageIO/imageio.h>
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

/// The OpenImageIO format of a Display type. Interactive types of other renderers become files.
slvm::Result<Format> choose_format(const DisplayRequest& d) {
  std::string extension = fs::path(d.name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  auto known = [](const std::string& name) { return OIIO::ImageOutput::create(name) != nullptr; };
  const std::string& t = d.type;
  if (t == "tiff" || t == "tif") return Format{"tiff", "tif"};
  if (t == "png") return Format{"png", "png"};
  if (t == "openexr" || t == "exr") return Format{"openexr", "exr"};
  if (t == "zfile" || t == "shadow") return Format{"tiff", "z"};
  if (t == "file" || t == "framebuffer" || t == "it") {
    if (!extension.empty() && known(extension)) return Format{extension, extension};
    return Format{"tiff", "tif"};
  }
  if (known(t)) return Format{t, t};
  return slvm::Error{
      fmt::format("unknown type \"{}\"; expected \"tiff\", \"png\", \"openexr\", \"file\", \"null\" or "
                  "another format of OpenImageIO",
                  t)};
}

/// What one channel becomes: quantised integers or floats.
OIIO::TypeDesc pixel_type(const Quantization& q, const std::string& plugin) {
  bool integers_only = plugin == "png" || plugin == "jpeg" || plugin == "bmp" || plugin == "targa";
  bool floats_only = plugin == "openexr" || plugin == "hdr";
  if (floats_only || (q.is_float() && !integers_only)) return OIIO::TypeDesc::FLOAT;
  if (q.is_float()) return OIIO::TypeDesc::UINT16;
  if (q.min >= 0 && q.max <= 255) return OIIO::TypeDesc::UINT8;
  if (q.min >= 0 && q.max <= 65535) return OIIO::TypeDesc::UINT16;
  return OIIO::TypeDesc::FLOAT;
}

class Writer {
public:
  Writer(const Scene& scene, const Image& image, const std::vector<AovChannel>& aovs)
      : scene_(scene), options_(scene.options), image_(image), aovs_(aovs) {}

  /// The name of the file, or why there is none.
  slvm::Result<std::string> write(const DisplayRequest& d);

private:
  void fill_spec(OIIO::ImageSpec& spec, const std::vector<FileChannel>& channels) const;
  float value(const FileChannel& channel, const DisplaySettings& settings, int x, int y) const;
  template <class T>
  std::vector<std::byte> pack(const std::vector<FileChannel>& channels, const DisplaySettings& settings,
                              const Quantization& color, const Quantization& depth) const;

  const Scene& scene_;
  const Options& options_;
  const Image& image_;
  const std::vector<AovChannel>& aovs_;
};

void Writer::fill_spec(OIIO::ImageSpec& spec, const std::vector<FileChannel>& channels) const {
  spec.x = image_.rect.x0;
  spec.y = image_.rect.y0;
  spec.full_width = options_.xres * (options_.subpixel ? options_.xsamples : 1);
  spec.full_height = options_.yres * (options_.subpixel ? options_.ysamples : 1);
  spec.channelnames.clear();
  for (size_t i = 0; i < channels.size(); ++i) {
    spec.channelnames.push_back(channels[i].name);
    if (channels[i].name == "A") spec.alpha_channel = static_cast<int>(i);
    if (channels[i].name == "Z") spec.z_channel = static_cast<int>(i);
  }
  spec.attribute("Software", "Anemone slrender");
  spec.attribute("PixelAspectRatio", options_.pixel_aspect);
  Camera camera(options_);
  // To the picture, x from -1 to 1 left to right, y from -1 to 1 upwards, as textureinfo() and shadow() want
  // it.
  Matrix4 to_screen =
      scene_.world_to_camera * camera.to_ndc() * translation({-0.5f, -0.5f, 0}) * scaling({2, -2, 1});
  spec.attribute("worldtocamera", OIIO::TypeMatrix, scene_.world_to_camera.m.data());
  spec.attribute("worldtoscreen", OIIO::TypeMatrix, to_screen.m.data());
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
  OIIO::TypeDesc type = pixel_type(is_depth ? depth : color, format->plugin);
  if (type == OIIO::TypeDesc::FLOAT && !color.set) color.one = 0;
  if (type == OIIO::TypeDesc::UINT16 && color.is_float()) color = {65535, 0, 65535, color.dither, true, 0};
  if (type != OIIO::TypeDesc::FLOAT && depth.is_float()) depth = color;

  OIIO::ImageSpec spec(image_.rect.width(), image_.rect.height(), static_cast<int>(channels.size()), type);
  fill_spec(spec, channels);
  // Rendered noise hardly gets smaller by trying harder.
  spec.attribute("tiff:zipquality", 2);
  spec.attribute("png:compressionLevel", 2);
  if (auto it = d.params.find("compression"); it != d.params.end() && !it->second.strings.empty())
    spec.attribute("compression", it->second.strings[0]);
  std::vector<std::byte> pixels;
  if (type == OIIO::TypeDesc::UINT8)
    pixels = pack<uint8_t>(channels, *settings, color, depth);
  else if (type == OIIO::TypeDesc::UINT16)
    pixels = pack<uint16_t>(channels, *settings, color, depth);
  else
    pixels = pack<float>(channels, *settings, color, depth);

  auto out = OIIO::ImageOutput::create(format->plugin);
  if (!out) return slvm::Error{OIIO::geterror()};
  std::string temporary = fmt::format("{}.{}.part", name, ::getpid());
  bool ok = out->open(temporary, spec) && out->write_image(type, pixels.data()) && out->close();
  std::error_code error;
  if (!ok) {
    std::string why = out->geterror();
    fs::remove(temporary, error);
    return slvm::Error{fmt::format("cannot write \"{}\": {}", name, why)};
  }
  fs::rename(temporary, name, error);
  if (!error) return name;
  std::string why = error.message();
  fs::remove(temporary, error);
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
