// Output through OpenImageIO.
#include "render/display/output.h"

#include "render/display/quantize.h"
#include "render/state/camera.h"
#include "render/state/declaration.h"
#include "render/state/transforms.h"
#include "slvm/format/shadeop_info.h"

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

/// One channel of a file: where in a pixel it comes from.
struct OutputChannel {
  std::string name;
  int source = 0;
  enum class Group : uint8_t { kColor, kDepth, kAov } group = Group::kColor;
};

bool is_standard_mode(std::string_view mode) {
  if (mode.empty()) return false;
  if (mode.starts_with("rgb")) mode.remove_prefix(3);
  if (mode.starts_with("a")) mode.remove_prefix(1);
  if (mode.starts_with("z")) mode.remove_prefix(1);
  return mode.empty();
}

/// A mode that names a variable: "varying color name", "color name", a name declared nowhere is a colour.
slvm::Result<AovChannel> parse_aov(const std::string& mode) {
  auto declared = Declarations().resolve(mode);
  if (declared) {
    if (declared->type == slvm::Type::kString || declared->type == slvm::Type::kMatrix ||
        declared->elements > 0)
      return slvm::Error{fmt::format("\"{}\" cannot be shown as an image", mode)};
    return AovChannel{declared->name, slvm::components(declared->type), 0, {}, {}};
  }
  if (mode.find_first_of(" \t[,") != std::string::npos) return slvm::Error{declared.error()};
  slvm::Global g = slvm::find_global(mode);
  if (g == slvm::Global::kCount) return AovChannel{mode, 3, 0, {}, {}};
  return AovChannel{mode, slvm::components(slvm::global_info(g).type), 0, {}, {}};
}

std::vector<OutputChannel> output_channels(const std::string& mode, const std::vector<AovChannel>& aovs) {
  std::vector<OutputChannel> out;
  using Group = OutputChannel::Group;
  if (is_standard_mode(mode)) {
    if (mode.find("rgb") != std::string::npos)
      for (int c = 0; c < 3; ++c)
        out.push_back({std::string(1, "RGB"[c]), Image::kCi + c, Group::kColor});
    if (mode.find('a') != std::string::npos) out.push_back({"A", Image::kAlpha, Group::kColor});
    if (mode.find('z') != std::string::npos) out.push_back({"Z", Image::kZ, Group::kDepth});
    return out;
  }
  auto wanted = parse_aov(mode);
  if (!wanted) return out;
  for (const AovChannel& a : aovs)
    if (a.name == wanted->name)
      for (int c = 0; c < a.components; ++c) {
        std::string name = a.components == 1 ? a.name : std::string(1, "RGB"[c]);
        out.push_back({name, Image::kAov + a.first + c, Group::kAov});
      }
  return out;
}

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
  if (floats_only || (q.one == 0 && !integers_only)) return OIIO::TypeDesc::FLOAT;
  if (q.one == 0) return OIIO::TypeDesc::UINT16;
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
  void fill_spec(OIIO::ImageSpec& spec, const std::vector<OutputChannel>& channels) const;
  template <class T>
  std::vector<std::byte> pack(const std::vector<OutputChannel>& channels, const Quantization& color,
                              const Quantization& depth) const;

  const Scene& scene_;
  const Options& options_;
  const Image& image_;
  const std::vector<AovChannel>& aovs_;
};

void Writer::fill_spec(OIIO::ImageSpec& spec, const std::vector<OutputChannel>& channels) const {
  spec.x = image_.rect.x0;
  spec.y = image_.rect.y0;
  spec.full_width = options_.xres;
  spec.full_height = options_.yres;
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

template <class T>
std::vector<std::byte> Writer::pack(const std::vector<OutputChannel>& channels, const Quantization& color,
                                    const Quantization& depth) const {
  const PixelRect& r = image_.rect;
  std::vector<std::byte> out(static_cast<size_t>(r.width()) * static_cast<size_t>(r.height()) *
                             channels.size() * sizeof(T));
  std::byte* at = out.data();
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x)
      for (const OutputChannel& c : channels) {
        float v = image_.pixel(x, y)[c.source];
        const Quantization& q = c.group == OutputChannel::Group::kDepth ? depth : color;
        T value;
        if constexpr (std::is_same_v<T, float>)
          value = q.one == 0 ? v : static_cast<T>(quantize(v, q, x, y, c.source));
        else
          value = static_cast<T>(quantize(v, q, x, y, c.source));
        std::memcpy(at, &value, sizeof(T));
        at += sizeof(T);
      }
  return out;
}

slvm::Result<std::string> Writer::write(const DisplayRequest& d) {
  std::vector<OutputChannel> channels = output_channels(d.mode, aovs_);
  if (channels.empty()) return slvm::Error{fmt::format("unknown mode \"{}\"", d.mode)};
  auto format = choose_format(d);
  if (!format) return slvm::Error{format.error()};
  std::string name = d.name;
  if (fs::path(name).extension().empty()) name += "." + format->extension;

  // Variables of shaders are floats unless the display says otherwise.
  bool is_depth = channels[0].group == OutputChannel::Group::kDepth;
  Quantization color = channels[0].group == OutputChannel::Group::kAov ? options_.z : options_.rgba;
  OIIO::TypeDesc type = pixel_type(is_depth ? options_.z : color, format->plugin);
  Quantization depth = options_.z;
  if (type == OIIO::TypeDesc::FLOAT && !color.set) color.one = 0;
  if (type == OIIO::TypeDesc::UINT16 && color.one == 0) color = {65535, 0, 65535, 0.5f, true};
  if (type != OIIO::TypeDesc::FLOAT && depth.one == 0) depth = color;

  OIIO::ImageSpec spec(image_.rect.width(), image_.rect.height(), static_cast<int>(channels.size()), type);
  fill_spec(spec, channels);
  if (auto it = d.params.find("compression"); it != d.params.end() && !it->second.strings.empty())
    spec.attribute("compression", it->second.strings[0]);
  std::vector<std::byte> pixels;
  if (type == OIIO::TypeDesc::UINT8)
    pixels = pack<uint8_t>(channels, color, depth);
  else if (type == OIIO::TypeDesc::UINT16)
    pixels = pack<uint16_t>(channels, color, depth);
  else
    pixels = pack<float>(channels, color, depth);

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

std::vector<AovChannel> display_aovs(const Options& options, slvm::Diagnostics& diagnostics) {
  std::vector<AovChannel> out;
  int floats = 0;
  for (const DisplayRequest& d : options.displays) {
    if (is_standard_mode(d.mode) || d.type == "null") continue;
    auto aov = parse_aov(d.mode);
    if (!aov) {
      diagnostics.error(d.where, "Display: " + aov.error());
      continue;
    }
    bool known =
        std::any_of(out.begin(), out.end(), [&](const AovChannel& a) { return a.name == aov->name; });
    if (known) continue;
    aov->first = floats;
    floats += aov->components;
    out.push_back(*aov);
  }
  return out;
}

std::vector<std::string> write_displays(const Scene& scene, const Image& image,
                                        const std::vector<AovChannel>& aovs, slvm::Diagnostics& diagnostics) {
  std::vector<std::string> written;
  assert(aovs.empty() || image.channels == Image::kAov + aovs.back().first + aovs.back().components);
  Writer writer(scene, image, aovs);
  for (const DisplayRequest& d : scene.options.displays) {
    if (d.type == "null") continue;
    auto name = writer.write(d);
    if (name)
      written.push_back(*name);
    else
      diagnostics.error(d.where, "Display: " + name.error());
  }
  return written;
}

} // namespace render
