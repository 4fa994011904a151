// From finished pixels to image files: what each channel becomes, and where.
#include "render/display/output.h"

#include "render/display/channels.h"
#include "render/display/file_format.h"
#include "render/display/quantize.h"
#include "render/display/quantize_row.h"
#include "render/state/camera.h"
#include "render/state/transforms.h"
#include "render/texture/image_file.h"
#include "slvm/support/whole_file.h"

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
  void describe(ImageFile& file, const std::vector<FileChannel>& channels) const;
  template <class T> std::vector<std::byte> pack(const std::vector<FileChannel>& channels) const;

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

/// A channel's values, into pixels of `step` channels.
template <class From, class To> void interleave(std::span<const From> from, To* to, size_t step) {
  for (size_t k = 0; k < from.size(); ++k)
    to[k * step] = static_cast<To>(from[k]);
}

template <class T> std::vector<std::byte> Writer::pack(const std::vector<FileChannel>& channels) const {
  const PixelRect& r = image_.rect;
  const auto width = static_cast<size_t>(r.width());
  std::vector<std::byte> out(width * static_cast<size_t>(r.height()) * channels.size() * sizeof(T));
  auto* row = reinterpret_cast<T*>(out.data());
  std::vector<int> whole(width);
  std::vector<uint64_t> hashes(width);
  for (int y = r.y0; y < r.y1; ++y, row += width * channels.size()) {
    int group = -1;
    for (size_t c = 0; c < channels.size(); ++c) {
      const int source = channels[c].source;
      const float* values = image_.row(source, r.x0, y);
      if (std::is_same_v<T, float> && channels[c].quantization.is_float()) {
        interleave(std::span(values, width), row + c, channels.size());
        continue;
      }
      if (const int own = Quantizer::group_of(source); own != group) {
        group = own;
        hash_row(r.x0, y, group, hashes);
      }
      quantize_row(channels[c].quantization, source, hashes, values, whole.data());
      interleave(std::span<const int>(whole), row + c, channels.size());
    }
  }
  return out;
}

/// One file has one type, that of its first channel. The others adapt.
void fit_to(PixelType type, std::vector<FileChannel>& channels) {
  for (FileChannel& c : channels) {
    Quantization& q = c.quantization;
    if (type == PixelType::kFloat && !q.set) q.one = q.zero;
    if (type == PixelType::kShort && q.is_float()) q = {65535, 0, 65535, q.dither, true, 0};
    if (type == PixelType::kByte && q.is_float()) q = channels[0].quantization;
  }
}

/// The name a Display gives, in the current folder when its own is not there: scenes name folders of the
/// machine they were made on, and a picture in another place is better than none.
std::string file_name(const DisplayRequest& d) {
  fs::path path(d.name), folder = path.parent_path();
  std::error_code error;
  return folder.empty() || fs::is_directory(folder, error) || !path.has_filename() ? d.name
                                                                                   : path.filename().string();
}

/// Empty: display_aovs() has reported that there is nothing to write.
slvm::Result<std::string> Writer::write(const DisplayRequest& d) {
  std::vector<FileChannel> channels = file_channels(options_, d, aovs_);
  if (channels.empty()) return std::string();
  FileFormat format = choose_format(d);
  std::string name = file_name(d);
  if (fs::path(name).extension().empty()) name += "." + format.extension;
  PixelType type = pixel_type(channels[0].quantization, format.plugin);
  fit_to(type, channels);

  slvm::WholeFile whole(name);
  ImageFile file;
  describe(file, channels);
  file.path = whole.temporary();
  file.format = format.plugin;
  file.type = type;
  add_parameters(d, file);
  if (type == PixelType::kByte)
    file.pixels = pack<uint8_t>(channels);
  else if (type == PixelType::kShort)
    file.pixels = pack<uint16_t>(channels);
  else
    file.pixels = pack<float>(channels);

  std::string why = write_image_file(file);
  if (why.empty()) why = whole.commit();
  if (why.empty()) return name;
  return slvm::Error{fmt::format("cannot write \"{}\": {}", name, why)};
}

/// Says what becomes of a Display that cannot be had as it is wanted.
void warn_of_changes(const DisplayRequest& d, slvm::Diagnostics& diagnostics) {
  if (FileFormat format = choose_format(d); !format.known)
    diagnostics.warning(
        d.where, "display",
        fmt::format(
            "Display: type \"{}\" is not known and taken for \"file\": the picture is written as {}; known "
            "are \"tiff\", \"png\", \"openexr\", \"file\", \"null\" and other formats of OpenImageIO",
            d.type, format.plugin));
  if (std::string name = file_name(d); name != d.name)
    diagnostics.warning(
        d.where, "display",
        fmt::format("Display: there is no folder \"{}\"; the picture is written to \"{}\" here",
                    fs::path(d.name).parent_path().string(), name));
}

void warn_of_compression(const DisplayRequest& d, slvm::Diagnostics& diagnostics) {
  auto it = d.params.find("compression");
  if (it == d.params.end()) return;
  FileFormat format = choose_format(d);
  std::vector<std::string_view> known = compressions(format.plugin);
  std::string wanted = lower_case(it->second.strings[0]);
  if (known.empty())
    diagnostics.warning(
        d.where, "display",
        fmt::format("Display: \"compression\" has no effect: {} files have no choice of it", format.plugin));
  else if (!is_compression(format.plugin, wanted))
    diagnostics.warning(d.where, "display",
                        fmt::format("Display: {} files have no compression \"{}\"; known are {}",
                                    format.plugin, wanted, fmt::join(known, ", ")));
}

} // namespace

std::vector<std::string> write_displays(const Scene& scene, const Image& image,
                                        const std::vector<AovChannel>& aovs, slvm::Diagnostics& diagnostics) {
  std::vector<std::string> written;
  assert(aovs.empty() || image.channels == Image::kAov + aovs.back().first + aovs.back().components);
  Writer writer(scene, image, aovs);
  for (const DisplayRequest& d : scene.options.displays) {
    if (d.type == "null") continue;
    warn_of_changes(d, diagnostics);
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
