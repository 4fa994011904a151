// The order in which names are tried.
#include "render/texture/find_image.h"

#include "slvm/support/path_list.h"

#include <filesystem>

namespace render {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kExtensions[] = {".tif", ".tiff", ".tx",  ".tex", ".exr", ".png",
                                            ".jpg", ".jpeg", ".env", ".hdr", ".tga"};

std::optional<std::string> in_folders(const std::string& name, const std::vector<std::string>& folders) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) return name;
  std::string found = slvm::find_in_folders(name, folders);
  return found.empty() ? std::nullopt : std::optional(std::move(found));
}

std::optional<std::string> with_extensions(const fs::path& name, const std::vector<std::string>& folders) {
  if (auto found = in_folders(name.string(), folders)) return found;
  for (std::string_view extension : kExtensions) {
    fs::path other = name;
    if (auto found = in_folders(other.replace_extension(extension).string(), folders)) return found;
  }
  // wood.tif may have been made into wood.tif.tx, or be wanted as such.
  for (std::string_view extension : kExtensions)
    if (auto found = in_folders(name.string() + std::string(extension), folders)) return found;
  return {};
}

} // namespace

std::optional<std::string> find_image(std::string_view name, const std::vector<std::string>& folders) {
  if (name.empty()) return {};
  std::string plain(name);
  // Scenes of Windows write backslashes.
  for (char& c : plain)
    if (c == '\\') c = '/';
  for (const std::string& candidate : {std::string(name), plain}) {
    if (auto found = with_extensions(candidate, folders)) return found;
    fs::path last = fs::path(candidate).filename();
    if (last == fs::path(candidate)) continue;
    if (auto found = with_extensions(last, folders)) return found;
  }
  return {};
}

} // namespace render
