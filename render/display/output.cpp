// Output through OpenImageIO.
#include "render/display/output.h"

#include "render/display/channels.h"
#include "render/display/file_format.h"
#include "render/display/quantize.h"
#include "render/state/camera.h"
#include "render/state/transforms.h"
#include "slvm/support/whole_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <filesystem>
#include <span>

namespace render {

namespace {

namespace fs = std::filesystem;

class Writer {
public:
  Writer(const Scene& scene, const Image& image, const std::vector<AovChannel>& aovs)
      : scene_(scene), options_(scene.options), image_(image), aovs_(aovs) {}

  /// The name of the file, or why there is none.
  slvm::Result<std::string> write(const DisplayRequest& d);

private:
  void fill_spec(OIIO::ImageSpec& spec, const std::vector<FileChannel>& channels) const;
  template <class T> std::vector<std::byte> pack(const std::vector<FileChannel>& channels) const;

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

template <class T> std::vector<std::byte> Writer::pack(const std::vector<FileChannel>& channels) const {
  const PixelRect& r = image_.rect;
  std::vector<std::byte> out(static_cast<size_t>(r.width()) * static_cast<size_t>(r.height()) *
                             channels.size() * sizeof(T));
  std::byte* at = out.data();
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x)
      for (const FileChannel& c : channels) {
        float v = image_.pixel(x, y)[c.source];
        const Quantization& q = c.quantization;
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

/// One file has one type, that of its first channel. The others adapt.
void fit_to(OIIO::TypeDesc type, std::vector<FileChannel>& channels) {
  for (FileChannel& c : channels) {
    Quantization& q = c.quantization;
    if (type == OIIO::TypeDesc::FLOAT && !q.set) q.one = q.zero;
    if (type == OIIO::TypeDesc::UINT16 && q.is_float()) q = {65535, 0, 65535, q.dither, true, 0};
    if (type == OIIO::TypeDesc::UINT8 && q.is_float()) q = channels[0].quantization;
  }
}

/// Empty: display_aovs() has reported that there is nothing to write.
slvm::Result<std::string> Writer::write(const DisplayRequest& d) {
  std::vector<FileChannel> channels = file_channels(options_, d, aovs_);
  if (channels.empty()) return std::string();
  auto format = choose_format(d);
  if (!format) return slvm::Error{format.error()};
  std::string name = d.name;
  if (fs::path(name).extension().empty()) name += "." + format->extension;
  OIIO::TypeDesc type = pixel_type(channels[0].quantization, format->plugin);
  fit_to(type, channels);

  OIIO::ImageSpec spec(image_.rect.width(), image_.rect.height(), static_cast<int>(channels.size()), type);
  fill_spec(spec, channels);
  add_parameters(d, format->plugin, spec);
  std::vector<std::byte> pixels;
  if (type == OIIO::TypeDesc::UINT8)
    pixels = pack<uint8_t>(channels);
  else if (type == OIIO::TypeDesc::UINT16)
    pixels = pack<uint16_t>(channels);
  else
    pixels = pack<float>(channels);

  auto out = OIIO::ImageOutput::create(format->plugin);
  if (!out) return slvm::Error{OIIO::geterror()};
  slvm::WholeFile file(name);
  bool ok = out->open(file.temporary(), spec) && out->write_image(type, pixels.data()) && out->close();
  std::string why = ok ? file.commit() : out->geterror();
  if (why.empty()) return name;
  return slvm::Error{fmt::format("cannot write \"{}\": {}", name, why)};
}

void warn_of_compression(const DisplayRequest& d, slvm::Diagnostics& diagnostics) {
  auto it = d.params.find("compression");
  auto format = choose_format(d);
  if (it == d.params.end() || !format) return;
  std::vector<std::string_view> known = compressions(format->plugin);
  std::string wanted = lower_case(it->second.strings[0]);
  if (known.empty())
    diagnostics.warning(
        d.where, "display",
        fmt::format("Display: \"compression\" has no effect: {} files have no choice of it", format->plugin));
  else if (std::find(known.begin(), known.end(), wanted) == known.end())
    diagnostics.warning(d.where, "display",
                        fmt::format("Display: {} files have no compression \"{}\"; known are {}",
                                    format->plugin, wanted, fmt::join(known, ", ")));
}

} // namespace

std::vector<std::string> write_displays(const Scene& scene, const Image& image,
                                        const std::vector<AovChannel>& aovs, slvm::Diagnostics& diagnostics) {
  std::vector<std::string> written;
  assert(aovs.empty() || image.channels == Image::kAov + aovs.back().first + aovs.back().components);
  Writer writer(scene, image, aovs);
  for (const DisplayRequest& d : scene.options.displays) {
    if (d.type == "null") continue;
    warn_of_compression(d, diagnostics);
    auto name = writer.write(d);
    if (name && !name->empty())
      written.push_back(*name);
    else if (!name)
      diagnostics.error(d.where, "Display: " + name.error());
  }
  return written;
}

} // namespace render
