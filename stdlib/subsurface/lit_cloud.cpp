#include "stdlib/subsurface/lit_cloud.h"

#include "slvm/support/files.h"
#include "stdlib/subsurface/ply.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace subsurface {
namespace {

namespace fs = std::filesystem;

std::string tree_name(const std::string& folder, const std::string& cloud) {
  std::error_code ec;
  const std::string whole = fs::absolute(cloud, ec).lexically_normal().string();
  uint64_t number = 0xcbf29ce484222325; // FNV-1a
  for (const char c : whole)
    number = (number ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return (fs::path(folder) / fmt::format("{}-{:016x}.tree", fs::path(cloud).stem().string(), number))
      .string();
}

} // namespace

std::shared_ptr<const DiffusionMaterial> LitCloud::material(Color mean_free_path, float eta) {
  const Key key{mean_free_path.x, mean_free_path.y, mean_free_path.z, eta};
  std::lock_guard lock(mutex_);
  auto found = std::find_if(materials_.begin(), materials_.end(), [&](auto& m) { return m.first == key; });
  if (found == materials_.end()) {
    if (materials_.size() == kMostMaterials) materials_.erase(materials_.begin());
    materials_.emplace_back(
        key, std::make_shared<DiffusionMaterial>(tree_, mean_free_path, static_cast<double>(eta)));
  } else {
    std::rotate(found, found + 1, materials_.end());
  }
  return materials_.back().second;
}

size_t LitCloud::bytes() const {
  std::lock_guard lock(mutex_);
  size_t sum = tree_.bytes();
  for (const auto& [key, material] : materials_)
    sum += material->bytes();
  return sum;
}

void CloudCache::configure(Settings settings) {
  std::lock_guard lock(mutex_);
  settings_ = std::move(settings);
}

slvm::Result<CloudCache::Found> CloudCache::get(const std::string& path) {
  auto stamp = stamp_of(path);
  if (!stamp) return slvm::Error{stamp.error()};
  std::shared_ptr<Entry> entry;
  std::string folder;
  {
    std::lock_guard lock(mutex_);
    auto& slot = entries_[path];
    if (!slot) slot = std::make_shared<Entry>();
    entry = slot;
    entry->used = ++clock_;
    folder = settings_.folder;
  }
  std::lock_guard turn(entry->turn);
  if (entry->known && entry->stamp == *stamp) {
    std::lock_guard lock(mutex_);
    ++counts_.in_memory;
    return entry->found;
  }
  auto found = load(path, *stamp, folder);
  std::lock_guard lock(mutex_);
  entry->known = true;
  entry->stamp = *stamp;
  entry->found = found;
  make_room(*entry);
  return found;
}

slvm::Result<CloudCache::Found> CloudCache::load(const std::string& path, const FileStamp& stamp,
                                                 const std::string& folder) {
  const std::string kept = folder.empty() ? "" : tree_name(folder, path);
  auto count = [&](uint64_t Counts::*what) {
    std::lock_guard lock(mutex_);
    ++(counts_.*what);
  };
  if (!kept.empty())
    if (auto bytes = slvm::read_file(kept, kMostPlyBytes))
      if (auto tree = TreeFile::parse(*bytes, stamp, kept)) { // else it is made anew
        count(&Counts::on_disk);
        return Found{std::make_shared<LitCloud>(std::move(*tree)), ""};
      }
  auto cloud = read_point_cloud(path);
  if (!cloud) return slvm::Error{cloud.error()};
  auto tree = DiffusionTree::build(*cloud);
  if (!tree) return slvm::Error{fmt::format("{}: {}", path, tree.error())};
  count(&Counts::built);
  Found found;
  if (!kept.empty()) {
    std::error_code ec;
    fs::create_directories(folder, ec);
    if (auto written = slvm::write_file(kept, TreeFile::format(*tree, stamp)); !written)
      found.warning = written.error();
  }
  found.cloud = std::make_shared<LitCloud>(std::move(*tree));
  return found;
}

/// Forgets what nobody uses, but not `keep`.
void CloudCache::make_room(const Entry& keep) {
  auto bytes_of = [](const Entry& e) {
    return e.known && e.found && e.found->cloud ? e.found->cloud->bytes() : 0;
  };
  size_t total = 0;
  for (const auto& [path, entry] : entries_)
    total += bytes_of(*entry);
  while (total > settings_.most_bytes) {
    auto oldest = entries_.end();
    for (auto it = entries_.begin(); it != entries_.end(); ++it)
      if (const Entry& e = *it->second;
          &e != &keep && bytes_of(e) > 0 && e.found->cloud.use_count() == 1 && it->second.use_count() == 1)
        if (oldest == entries_.end() || e.used < oldest->second->used) oldest = it;
    if (oldest == entries_.end()) return;
    total -= bytes_of(*oldest->second);
    entries_.erase(oldest);
    ++counts_.given_up;
  }
}

CloudCache::Counts CloudCache::counts() const {
  std::lock_guard lock(mutex_);
  return counts_;
}

size_t CloudCache::bytes() const {
  std::lock_guard lock(mutex_);
  size_t sum = 0;
  for (const auto& [path, entry] : entries_)
    if (entry->known && entry->found) sum += entry->found->cloud->bytes();
  return sum;
}

slvm::Result<CloudCache::Found> FrameClouds::get(std::string_view path) {
  std::lock_guard lock(mutex_);
  if (auto found = clouds_.find(path); found != clouds_.end()) return found->second;
  const std::string name(path);
  return clouds_.emplace(name, cache_.get(name)).first->second;
}

} // namespace subsurface
