#include "slvm/format/stale.h"

#include "slvm/format/slo.h"

#include <filesystem>
#include <fmt/format.h>

namespace slvm {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Where the main source lies; empty when nowhere.
fs::path find_main(const std::string& name, const std::string& slo_path) {
  if (name.empty() || name.starts_with("<")) return {}; // standard input
  const fs::path given(name), folder = fs::path(slo_path).parent_path();
  // An absolute name stays what it is behind any folder.
  for (const fs::path& candidate : {folder / given, folder / given.filename(), given})
    if (is_file(candidate)) return candidate;
  return {};
}

// The same way from the main file as when it was compiled.
fs::path find_included(const std::string& name, const std::string& main_name, const fs::path& main) {
  const fs::path given(name), folder = fs::path(main_name).parent_path();
  if (given.is_absolute() && !fs::path(main_name).is_absolute()) return is_file(given) ? given : fs::path();
  const fs::path way = folder.empty() ? given : given.lexically_relative(folder);
  fs::path candidate = (main.parent_path() / (way.empty() ? given : way)).lexically_normal();
  return is_file(candidate) ? candidate : fs::path();
}

} // namespace

std::vector<SourceCheck> check_sources(const Program& program, const std::string& slo_path) {
  std::vector<SourceCheck> checks;
  for (const SourceFile& source : program.sources) {
    SourceCheck& check = checks.emplace_back();
    check.name = source.name;
    check.path = find_source(program, slo_path, source.name);
    if (check.path.empty()) continue;
    auto bytes = read_file(check.path);
    if (bytes) check.state = hash_bytes(*bytes) == source.hash ? SourceState::kSame : SourceState::kChanged;
  }
  return checks;
}

std::string stale_warning(const Program& program, const std::string& slo_path, bool source_taken) {
  for (const SourceCheck& check : check_sources(program, slo_path))
    if (check.state == SourceState::kChanged)
      return fmt::format("{} is older than its source: {} has changed; {}", slo_path, check.path,
                         source_taken ? "the source is taken" : "compile it again with slc");
  return "";
}

std::string find_source(const Program& program, const std::string& slo_path, const std::string& name) {
  const fs::path main = find_main(program.source_name, slo_path);
  if (name == program.source_name || main.empty()) return main.string();
  return find_included(name, program.source_name, main).string();
}

} // namespace slvm
