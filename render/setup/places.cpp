// Finding what was installed.
#include "render/setup/places.h"

#include "render/state/search_path.h"

#include <cstdlib>
#include <filesystem>

namespace render::setup {

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
  if (out.empty() && fs::is_directory(INSTALLED_SHADERS, error)) out.emplace_back(INSTALLED_SHADERS);
  return out;
}

} // namespace

std::vector<std::string> standard_shader_folders() {
  return existing({"../share/anemone/shaders", "../shaders", "../../../shaders/standard"});
}

std::vector<std::string> search_path(const std::string& option, const char* variable,
                                     const std::vector<std::string>& installed) {
  const char* environment = std::getenv(variable);
  std::vector<std::string> standard{"."};
  standard.insert(standard.end(), installed.begin(), installed.end());
  if (environment) standard = parse_search_path(environment, {}, standard);
  return option.empty() ? standard : parse_search_path(option, {}, standard);
}

std::vector<std::string> procedural_folders(const std::string& option, const char* variable) {
  if (option.empty() && !std::getenv(variable)) return {};
  return search_path(option, variable, {});
}

} // namespace render::setup
