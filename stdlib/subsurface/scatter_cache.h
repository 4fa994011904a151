// The irradiance of scatter maps, computed when it is first needed and kept (Tomson, 5.3: "on-the-fly
// irradiance cache" with grid counting), in the calls that a shader makes:
//
//   grid.read_map("skin.ply");                      // once a grid
//   index = grid.add_grid_point(Pworld, D);         // each point
//   while (grid.get_sample(Ps, Ns, As))             // each point, pass by pass
//     grid.save_irradiance(light at Ps, Ns);
//   color = grid.scatter(index, Pworld, Nworld, D, tint);
//
// A renderer runs each line for all points of a grid before the next. So samples are handed out in a queue,
// and light comes back in its order; and since lights run for whole grids, whatever the number of samples, a
// pass is filled up with samples that are not needed yet.
#pragma once

#include "stdlib/subsurface/scatter_map.h"
#include "stdlib/subsurface/tree_file.h"

#include <atomic>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_set>

namespace subsurface {

/// A scatter map and the light of its samples. Thread-safe.
class LitMap {
public:
  explicit LitMap(ScatterMap map);

  const ScatterMap& map() const { return map_; }
  /// How many samples have light; how often light came for one that had it already.
  size_t lit() const { return lit_.load(); }
  size_t duplicates() const { return duplicates_.load(); }

  // The life of a sample: nobody's, claimed by a grid (`owner`, above 1) that will light it, lit.
  enum class Claim { kMine, kMineAlready, kOthers, kLit };
  Claim claim(size_t sample, uint32_t owner);
  /// Gives up a claim of this owner; nothing happens if it was lit.
  void release(size_t sample, uint32_t owner);
  /// The light of a sample; the first that is saved stays.
  void save(size_t sample, Color irradiance);
  bool is_lit(size_t sample) const { return state_[sample].load(std::memory_order_acquire) == kLitState; }
  /// Of a lit sample.
  Color irradiance(size_t sample) const { return irradiance_[sample]; }
  /// Claims some sample that nobody has; false: there is none.
  bool claim_any(uint32_t owner, size_t& sample);

private:
  static constexpr uint32_t kFree = 0, kLitState = 1, kWriting = ~0u;

  ScatterMap map_;
  std::vector<std::atomic<uint32_t>> state_; // or the owner's number
  std::vector<Color> irradiance_;
  std::atomic<size_t> next_{0}, lit_{0}, duplicates_{0};
};

/// The maps of a scene, each read once. Thread-safe.
class ScatterMaps {
public:
  using Loader = std::function<slvm::Result<PointCloud>(const std::string& name)>;
  /// What the loader's files are like; other stamps: they have changed.
  using Stamper = std::function<std::vector<FileStamp>(const std::string& name)>;
  static constexpr size_t kUsualBytes = size_t{256} << 20;

  /// The loader turns a name into samples; read_point_cloud() is one. It is called once for each name, one at
  /// a time.
  explicit ScatterMaps(Loader loader, Stamper stamper = {})
      : loader_(std::move(loader)), stamper_(std::move(stamper)) {}

  slvm::Result<std::shared_ptr<LitMap>> get(const std::string& name);
  /// Forgets all light, for a change of lights. Maps stay, but for those whose files have changed or could
  /// not be read. Grids that are at work end with what they have.
  void forget_light();
  /// How much of the samples of maps by faces is in memory.
  BlockPool& pool() { return *pool_; }
  /// A number that no other grid has.
  uint32_t new_owner() { return owners_.fetch_add(1); }

private:
  struct Entry {
    slvm::Result<std::shared_ptr<LitMap>> map;
    std::vector<FileStamp> stamps;
  };
  std::vector<FileStamp> stamps_of(const std::string& name) const {
    return stamper_ ? stamper_(name) : std::vector<FileStamp>();
  }

  Loader loader_;
  Stamper stamper_;
  std::shared_ptr<BlockPool> pool_ = std::make_shared<BlockPool>(kUsualBytes);
  std::mutex mutex_;
  std::map<std::string, Entry, std::less<>> maps_;
  std::atomic<uint32_t> owners_{2};
};

/// The calls for one grid at a time; each thread has its own.
class ScatterGrid {
public:
  explicit ScatterGrid(ScatterMaps& maps) : maps_(maps), owner_(maps.new_owner()) {}
  ~ScatterGrid() { forget_grid(); }
  ScatterGrid(const ScatterGrid&) = delete;
  ScatterGrid& operator=(const ScatterGrid&) = delete;

  /// Begins a grid: forgets the one before, and counts points from 0. The error is that of the loader; the
  /// grid then has no samples and gets no light.
  slvm::Result<bool> read_map(const std::string& name);
  /// Finds the samples within D of P and claims those without light. Returns the point's index.
  uint32_t add_grid_point(Vec3 P, float D);
  /// A sample that needs light; false when all that the grid needs are on their way and the pass is full.
  /// Samples that another thread's grid has claimed come last; if their light is still not there they are lit
  /// here as well. (Waiting for them could lock up renderers whose threads take up other work in between.)
  bool get_sample(Vec3& P, Vec3& N, float& area);
  /// Light for the sample that was handed out first of those that have none yet.
  void save_irradiance(Color irradiance);
  /// The sum over the samples near the point: area times irradiance times T times B, times the tint
  /// [power/length^2].
  Color scatter(uint32_t index, Vec3 P, Vec3 N, float D, Color tint) const;

  /// Samples that were handed out and have no light yet.
  size_t in_flight() const { return in_flight_.size(); }
  uint32_t grid_points() const { return static_cast<uint32_t>(ends_.size()); }

private:
  void forget_grid();
  bool next_sample(size_t& sample);
  void need(uint32_t sample);

  ScatterMaps& maps_;
  uint32_t owner_;
  std::shared_ptr<LitMap> map_;
  mutable std::optional<ScatterReader> reader_; // of map_
  std::vector<uint32_t> near_;                  // samples near each point, one point after another
  std::vector<size_t> ends_;                    // where in near_ those of each point end
  size_t listed_ = 0; // points from here on are not in near_, which would be too long: they search anew
  std::deque<uint32_t> required_, foreign_, in_flight_;
  std::unordered_set<uint32_t> foreign_seen_;
  size_t handed_out_ = 0;
};

} // namespace subsurface
