// Finding what was installed.
#include "render/tools/places.h"

#include <filesystem>

namespace render::tools {

namespace {

namespace fs = std::filesystem;

/// Those of the places, relative to the program's folder, that exist.
std::vector<std::string> existing(std::initializer_list<const char*> places) {
  std::vector<std::string> out;
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return out;
  for (const char* place : places)
    if (fs::is_directory(folder / place, error))
      out.push_back(fs::weakly_canonical(folder / place, error).string());
  return out;
}

} // namespace

std::vector<std::string> standard_shader_folders() {
  return existing({"../share/anemone/shaders", "../shaders", "../../../shaders/standard"});
}

} // namespace render::tools
