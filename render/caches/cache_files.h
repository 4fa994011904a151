// The irradiance caches of a frame: those that are read, as they are when the frame begins, and those that
// are written when it ends. What a frame writes it does not read, so that nothing depends on the order of
// work.
#pragma once

#include "render/caches/irradiance_cache.h"
#include "slvm/irradiance_cache.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace render {

class CacheFiles final : public slvm::IrradianceCacheServices {
public:
  /// `find` turns the name in a scene into the path of a file that is read; files are written to the name
  /// itself.
  explicit CacheFiles(std::function<std::string(std::string_view)> find = {}) : find_(std::move(find)) {}

  std::string insert(const slvm::IrradianceInsert&) override;
  std::string query(const slvm::IrradianceQuery&) override;

  /// A file that is read: its cache, or (null) why there is none. It lives as long as this.
  struct Source {
    std::unique_ptr<const IrradianceCache> cache;
    std::string problem;
    bool missing = false; ///< there is no such file
  };
  const Source& source(std::string_view name);

  /// Adds to a file that is written when the frame ends, also if nothing is added. `keeps`: it begins with
  /// what it holds now.
  void add(std::string_view name, bool keeps, std::vector<IrradianceRecord> records);
  /// Writes the files; what went wrong.
  std::vector<std::string> write();
  /// Records of all files that are written, so far.
  size_t added() const;

private:
  /// More records than this, of some 250 bytes, are not taken.
  static constexpr size_t kMost = size_t{1} << 23;

  struct Target {
    std::mutex mutex;
    std::vector<IrradianceRecord> records;
    bool keeps = false, full = false;
  };
  std::string path_of(const std::string& name) const { return find_ ? find_(name) : name; }
  slvm::Result<std::vector<IrradianceRecord>> read(const std::string& name, bool& missing) const;
  Target& target(std::string_view name);
  std::string write(const std::string& name, Target& target);

  std::function<std::string(std::string_view)> find_;
  mutable std::mutex mutex_; ///< of both maps, not of what is in them
  struct Reading {
    std::once_flag once;
    Source source;
  };
  std::map<std::string, Reading, std::less<>> sources_;
  std::map<std::string, Target, std::less<>> targets_;
};

} // namespace render
