#include "slvm/plugin/finder.h"

#include <algorithm>
#include <fmt/format.h>

namespace slvm {
namespace {

void add(const std::vector<PluginEntry>& entries, const std::string& path, PluginSource::Functions& out) {
  for (const PluginEntry& e : entries)
    if (auto function = PluginShadeop::make({e.function, e.signature, path, e.form}))
      out.push_back(std::move(function));
}

} // namespace

std::shared_ptr<const PluginLibrary> PluginFinder::open(const std::string& path, std::string& error) const {
  auto [it, is_new] = opened_.try_emplace(path);
  if (is_new) {
    auto library = PluginLibrary::open(path);
    if (library)
      it->second.library = *library;
    else
      it->second.error = library.error();
  }
  error = it->second.error;
  return it->second.library;
}

PluginSource::Functions PluginFinder::find(std::string_view function,
                                           std::vector<std::string>& trouble) const {
  std::lock_guard lock(mutex_);
  std::vector<std::string> files = list_libraries(folders_);
  if (std::string own = find_library(function, folders_); !own.empty()) {
    std::erase(files, own);
    files.insert(files.begin(), own);
  }
  Functions found;
  for (const std::string& file : files) {
    std::string error;
    if (auto library = open(file, error))
      add(library->functions(std::string(function), trouble), file, found);
    else
      trouble.push_back(std::move(error));
    if (!found.empty()) break;
  }
  if (!found.empty()) trouble.clear();
  return found;
}

bool PluginFinder::load(std::string_view name, Functions& functions,
                        std::vector<std::string>& trouble) const {
  std::lock_guard lock(mutex_);
  const std::string file = find_library(name, folders_);
  if (file.empty()) {
    trouble.push_back(fmt::format("no such library: {}", plugin_folders_advice(folders_)));
    return false;
  }
  std::string error;
  auto library = open(file, error);
  if (!library) {
    trouble.push_back(std::move(error));
    return false;
  }
  for (const std::string& problem : library->grid_trouble())
    trouble.push_back(problem);
  if (!trouble.empty() && library->grid_functions().empty()) return false;
  add(library->grid_functions(), file, functions);
  return true;
}

PluginSource::Functions PluginFinder::find_in(std::string_view name, std::string_view function,
                                              std::vector<std::string>& trouble) const {
  std::lock_guard lock(mutex_);
  Functions found;
  std::string error;
  const std::string file = find_library(name, folders_);
  const auto library = file.empty() ? nullptr : open(file, error);
  if (!library) return found;
  std::vector<PluginEntry> entries = library->functions(std::string(function), trouble);
  std::erase_if(entries, [](const PluginEntry& e) { return e.form != PluginForm::kPointwise; });
  add(entries, file, found);
  return found;
}

} // namespace slvm
