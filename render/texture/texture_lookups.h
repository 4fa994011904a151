// Textures by the names of their files, and the lookups of whole grids in them.
#pragma once

#include "render/texture/texture_image.h"
#include "slvm/textures.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace render {

/// For many threads at once. Functions return "" or why nothing can be seen.
class TextureLookups {
public:
  /// Beyond the limit textures nobody looked at for longest leave the memory; they are read again when they
  /// are wanted.
  explicit TextureLookups(float memory_megabytes);

  std::string texture(const std::string& file, const slvm::TextureLookup& lookup);
  /// Of a latitude-longitude map.
  std::string environment(const std::string& file, const slvm::TextureLookup& lookup);
  /// slvm::TextureServices::info.
  bool info(const std::string& file, std::string_view field, const slvm::Matrix4& current_to_world,
            slvm::Value& out);
  /// slvm::TextureServices::texels.
  std::string texels(const std::string& file, size_t level, slvm::TextureTexels& out);
  /// Files read so far, and bytes of texels in memory.
  std::pair<long long, long long> usage();

private:
  struct Entry {
    std::shared_ptr<const TextureImage> image; ///< null: problem, or out of memory for now
    std::string problem;
    uint64_t last_use = 0;
  };
  /// Null with the reason.
  std::shared_ptr<const TextureImage> find(const std::string& file, std::string& problem);
  void make_room(const Entry& wanted);

  const long long most_bytes_;
  std::atomic<long long> bytes_{0};
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
  uint64_t uses_ = 0;
};

} // namespace render
