// Choice of formats, and their attributes.
#include "render/display/file_format.h"

#include "render/rib/parameters.h"
#include "render/texture/image_module.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

namespace render {

namespace fs = std::filesystem;

namespace {

bool is_format(const std::string& name) {
  if (name == "tif" || name == "tiff" || name == "png") return true;
  const ImageModule& module = image_module();
  return module.problem.empty() && module.knows_format(name);
}

/// Numbers of frames, "z", "tx", "xp": what maps and pictures are named by that are no format's. They need
/// not be asked for, which takes longer than many a picture does.
bool may_be_format(const std::string& extension) {
  const bool number =
      std::all_of(extension.begin(), extension.end(), [](unsigned char c) { return std::isdigit(c); });
  return !number && (extension.size() > 2 || extension == "bw");
}

/// What the extension of the file's name says; TIFF without one that is known.
FileFormat format_of_name(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  if (!may_be_format(extension) || !is_format(extension)) return {"tiff", "tif"};
  return {extension == "tif" ? "tiff" : extension == "jpg" ? "jpeg" : extension, extension};
}

} // namespace

FileFormat choose_format(const DisplayRequest& d) {
  const std::string& t = d.type;
  if (t == "tiff" || t == "tif") return {"tiff", "tif"};
  if (t == "png") return {"png", "png"};
  if (t == "openexr" || t == "exr") return {"openexr", "exr"};
  if (t == "zfile" || t == "shadow") return {"tiff", "z"};
  if (t == "file" || t == "framebuffer" || t == "it") return format_of_name(d.name);
  if (is_format(t)) return {t == "jpg" ? "jpeg" : t, t};
  FileFormat guess = format_of_name(d.name);
  guess.known = false;
  return guess;
}

PixelType pixel_type(const Quantization& q, const std::string& plugin) {
  bool integers_only = plugin == "png" || plugin == "jpeg" || plugin == "bmp" || plugin == "targa";
  bool floats_only = plugin == "openexr" || plugin == "hdr";
  if (floats_only || (q.is_float() && !integers_only)) return PixelType::kFloat;
  if (q.is_float()) return PixelType::kShort;
  if (q.min >= 0 && q.max <= 255) return PixelType::kByte;
  if (q.min >= 0 && q.max <= 65535) return PixelType::kShort;
  return PixelType::kFloat;
}

std::vector<std::string_view> compressions(const std::string& plugin) {
  if (plugin == "tiff") return {"none", "lzw", "zip", "packbits", "ccittrle"};
  if (plugin == "openexr")
    return {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
  if (plugin == "jpeg") return {"jpeg:1 to jpeg:100"};
  return {};
}

bool is_compression(const std::string& plugin, std::string_view name) {
  if (plugin == "jpeg") {
    int quality = 0;
    if (!name.starts_with("jpeg:")) return false;
    name.remove_prefix(5);
    auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), quality);
    return error == std::errc() && end == name.data() + name.size() && quality >= 1 && quality <= 100;
  }
  auto known = compressions(plugin);
  return std::find(known.begin(), known.end(), name) != known.end();
}

std::string lower_case(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void add_parameters(const DisplayRequest& d, ImageFile& file) {
  for (const auto& [name, value] : d.params) {
    if (name == "compression") {
      std::string wanted = lower_case(value.strings[0]);
      if (is_compression(file.format, wanted)) file.compression = wanted;
    } else if (name == "resolution") {
      file.attributes["XResolution"] = {slvm::Type::kFloat, 0, {value.numbers[0]}, {}};
      file.attributes["YResolution"] = {slvm::Type::kFloat, 0, {value.numbers[1]}, {}};
      file.attributes["ResolutionUnit"] = {slvm::Type::kString, 0, {}, {"in"}};
    } else if (!find_parameter(RequestId::kDisplay, "", name)) {
      file.attributes[name] = value;
    }
  }
}

} // namespace render
