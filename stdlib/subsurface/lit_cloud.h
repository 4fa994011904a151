// Lit clouds that lookups share: read once, kept in memory between frames, and as trees on disk between runs.
// What is kept is good as long as the cloud's file has not changed.
//
//   CloudCache                      of a run: all clouds, the least recently used go when memory is short
//     FrameClouds                   of a frame: each file is the same for all grids, whatever happens to it
//       LitCloud                    a cloud: its tree, and the dipoles of its points by material
#pragma once

#include "stdlib/subsurface/tree_file.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace subsurface {

/// A lit cloud, ready for lookups from any number of threads.
class LitCloud {
public:
  explicit LitCloud(DiffusionTree tree) : tree_(std::move(tree)) {}

  const DiffusionTree& tree() const { return tree_; }
  /// The dipoles by the points' own albedos. Made when first asked for; some are kept.
  std::shared_ptr<const DiffusionMaterial> material(Color mean_free_path, float eta);
  /// Memory that it takes.
  size_t bytes() const;

private:
  static constexpr size_t kMostMaterials = 4;

  using Key = std::array<float, 4>;
  DiffusionTree tree_;
  mutable std::mutex mutex_;
  std::vector<std::pair<Key, std::shared_ptr<const DiffusionMaterial>>> materials_; // the last used last
};

class CloudCache {
public:
  struct Settings {
    /// Clouds that no frame uses go, the least recently used first, while all together take more.
    size_t most_bytes = size_t{256} << 20;
    /// Where trees are kept: FOLDER/NAME-NUMBER.tree, the number from the whole path of the cloud. It is made
    /// when it is first needed. "": none are.
    std::string folder;
  };
  struct Found {
    std::shared_ptr<LitCloud> cloud;
    std::string warning; ///< "", or why its tree could not be kept on disk
  };
  /// What calls of get() found, and what they had to do.
  struct Counts {
    uint64_t in_memory = 0, on_disk = 0, built = 0, given_up = 0;
  };

  void configure(Settings settings);
  /// The error names the file.
  slvm::Result<Found> get(const std::string& path);
  Counts counts() const;
  /// Memory that all clouds take.
  size_t bytes() const;

private:
  struct Entry {
    std::mutex turn; ///< of who loads it
    bool known = false;
    FileStamp stamp;
    slvm::Result<Found> found = slvm::Error{};
    uint64_t used = 0; ///< when, as a count of calls
  };
  slvm::Result<Found> load(const std::string& path, const FileStamp& stamp, const std::string& folder);
  void make_room(const Entry& keep);

  mutable std::mutex mutex_;
  Settings settings_;
  Counts counts_;
  uint64_t clock_ = 0;
  std::map<std::string, std::shared_ptr<Entry>, std::less<>> entries_;
};

/// What a frame has got of a cache. Thread-safe.
class FrameClouds {
public:
  explicit FrameClouds(CloudCache& cache) : cache_(cache) {}
  slvm::Result<CloudCache::Found> get(std::string_view path);

private:
  CloudCache& cache_;
  std::mutex mutex_;
  std::map<std::string, slvm::Result<CloudCache::Found>, std::less<>> clouds_;
};

} // namespace subsurface
