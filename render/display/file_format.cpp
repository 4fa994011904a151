// Choice of formats, and their attributes.
#include "render/display/file_format.h"

#include "render/rib/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace render {

namespace fs = std::filesystem;

slvm::Result<FileFormat> choose_format(const DisplayRequest& d) {
  std::string extension = fs::path(d.name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  auto known = [](const std::string& name) { return OIIO::ImageOutput::create(name) != nullptr; };
  const std::string& t = d.type;
  if (t == "tiff" || t == "tif") return FileFormat{"tiff", "tif"};
  if (t == "png") return FileFormat{"png", "png"};
  if (t == "openexr" || t == "exr") return FileFormat{"openexr", "exr"};
  if (t == "zfile" || t == "shadow") return FileFormat{"tiff", "z"};
  if (t == "file" || t == "framebuffer" || t == "it") {
    if (!extension.empty() && known(extension)) return FileFormat{extension, extension};
    return FileFormat{"tiff", "tif"};
  }
  if (known(t)) return FileFormat{t, t};
  return slvm::Error{
      fmt::format("unknown type \"{}\"; expected \"tiff\", \"png\", \"openexr\", \"file\", \"null\" or "
                  "another format of OpenImageIO",
                  t)};
}

OIIO::TypeDesc pixel_type(const Quantization& q, const std::string& plugin) {
  bool integers_only = plugin == "png" || plugin == "jpeg" || plugin == "bmp" || plugin == "targa";
  bool floats_only = plugin == "openexr" || plugin == "hdr";
  if (floats_only || (q.is_float() && !integers_only)) return OIIO::TypeDesc::FLOAT;
  if (q.is_float()) return OIIO::TypeDesc::UINT16;
  if (q.min >= 0 && q.max <= 255) return OIIO::TypeDesc::UINT8;
  if (q.min >= 0 && q.max <= 65535) return OIIO::TypeDesc::UINT16;
  return OIIO::TypeDesc::FLOAT;
}

std::vector<std::string_view> compressions(const std::string& plugin) {
  if (plugin == "tiff") return {"none", "lzw", "zip", "packbits", "ccittrle"};
  if (plugin == "openexr")
    return {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
  return {};
}

std::string lower_case(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

namespace {

/// Metadata under its own name.
void add_attribute(const std::string& name, const slvm::Value& value, OIIO::ImageSpec& spec) {
  if (value.strings.size() == 1)
    spec.attribute(name, value.strings[0]);
  else if (value.numbers.size() == 1 && value.numbers[0] == std::floor(value.numbers[0]) &&
           std::abs(value.numbers[0]) < 1e9f)
    spec.attribute(name, static_cast<int>(value.numbers[0]));
  else if (!value.numbers.empty())
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(value.numbers.size())),
                   value.numbers.data());
}

} // namespace

void add_parameters(const DisplayRequest& d, const std::string& plugin, OIIO::ImageSpec& spec) {
  // Rendered noise hardly gets smaller by trying harder.
  spec.attribute("tiff:zipquality", 2);
  spec.attribute("png:compressionLevel", 2);
  for (const auto& [name, value] : d.params) {
    if (name == "compression") {
      auto known = compressions(plugin);
      std::string wanted = lower_case(value.strings[0]);
      if (std::find(known.begin(), known.end(), wanted) != known.end()) spec.attribute(name, wanted);
    } else if (name == "resolution") {
      spec.attribute("XResolution", value.numbers[0]);
      spec.attribute("YResolution", value.numbers[1]);
      spec.attribute("ResolutionUnit", "in");
    } else if (!find_parameter(RequestId::kDisplay, "", name)) {
      add_attribute(name, value, spec);
    }
  }
}

} // namespace render
