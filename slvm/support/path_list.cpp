#include "slvm/support/path_list.h"

#include <cctype>
#include <filesystem>

namespace slvm {

namespace fs = std::filesystem;

std::vector<std::string> split_path_list(std::string_view text) {
  std::vector<std::string> folders;
  std::string folder;
  auto finish = [&] {
    if (!folder.empty()) folders.push_back(std::move(folder));
    folder.clear();
  };
  for (size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    const bool drive = text[i] == ':' && folder.size() == 1 &&
                       std::isalpha(static_cast<unsigned char>(folder[0])) && (next == '/' || next == '\\');
    if (text[i] == ';' || (text[i] == ':' && !drive))
      finish();
    else
      folder += text[i];
  }
  finish();
  return folders;
}

std::string find_in_folders(const std::string& name, std::span<const std::string> folders) {
  std::error_code error;
  if (fs::path(name).is_absolute()) return fs::is_regular_file(name, error) ? name : "";
  for (const std::string& folder : folders)
    if (fs::path file = fs::path(folder) / name; fs::is_regular_file(file, error))
      return file.lexically_normal().string();
  return "";
}

std::string find_shader_file(const std::string& name, std::span<const std::string> folders) {
  if (name.ends_with(".sl") || name.ends_with(".slo")) return find_in_folders(name, folders);
  const std::string itself;
  if (fs::path(name).is_absolute()) folders = {&itself, 1};
  for (size_t i = 0; i < folders.size(); ++i)
    for (const char* suffix : {".slo", ".sl", ""})
      if (std::string file = find_in_folders(name + suffix, folders.subspan(i, 1)); !file.empty())
        return file;
  return "";
}

} // namespace slvm
