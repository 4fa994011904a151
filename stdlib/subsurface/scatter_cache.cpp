#include "stdlib/subsurface/scatter_cache.h"

#include <fmt/format.h>
#include <thread>

namespace subsurface {

LitMap::LitMap(ScatterMap map) : map_(std::move(map)), state_(map_.size()), irradiance_(map_.size()) {}

LitMap::Claim LitMap::claim(size_t sample, uint32_t owner) {
  uint32_t state = kFree;
  if (state_[sample].compare_exchange_strong(state, owner, std::memory_order_acq_rel)) return Claim::kMine;
  return state == kLitState ? Claim::kLit : state == owner ? Claim::kMineAlready : Claim::kOthers;
}

void LitMap::release(size_t sample, uint32_t owner) {
  state_[sample].compare_exchange_strong(owner, kFree, std::memory_order_acq_rel);
}

void LitMap::save(size_t sample, Color irradiance) {
  uint32_t state = state_[sample].load(std::memory_order_acquire);
  while (state != kLitState && state != kWriting)
    if (state_[sample].compare_exchange_weak(state, kWriting, std::memory_order_acq_rel)) {
      irradiance_[sample] = irradiance;
      state_[sample].store(kLitState, std::memory_order_release);
      ++lit_;
      return;
    }
  ++duplicates_;
  while (!is_lit(sample)) // another thread is at the two lines above
    std::this_thread::yield();
}

bool LitMap::claim_any(uint32_t owner, size_t& sample) {
  while ((sample = next_.fetch_add(1)) < map_.size())
    if (claim(sample, owner) == Claim::kMine) return true;
  next_.store(map_.size());
  return false;
}

slvm::Result<std::shared_ptr<LitMap>> ScatterMaps::get(const std::string& name) {
  std::lock_guard lock(mutex_);
  if (auto found = maps_.find(name); found != maps_.end()) return found->second.map;
  auto load = [&]() -> slvm::Result<std::shared_ptr<LitMap>> {
    auto cloud = loader_(name);
    if (!cloud) return slvm::Error{cloud.error()};
    auto map = ScatterMap::build(*cloud, pool_);
    if (!map) return slvm::Error{fmt::format("{}: {}", name, map.error())};
    return std::make_shared<LitMap>(std::move(*map));
  };
  std::vector<FileStamp> stamps = stamps_of(name); // of before it is read
  return maps_.emplace(name, Entry{load(), std::move(stamps)}).first->second.map;
}

void ScatterMaps::forget_light() {
  std::lock_guard lock(mutex_);
  std::erase_if(maps_, [&](const auto& item) {
    return !item.second.map || item.second.stamps != stamps_of(item.first);
  });
  for (auto& [name, entry] : maps_)
    if ((*entry.map)->lit() > 0) entry.map = std::make_shared<LitMap>((*entry.map)->map());
}

void ScatterGrid::forget_grid() {
  for (const auto* queue : {&required_, &in_flight_})
    for (uint32_t sample : *queue)
      map_->release(sample, owner_);
  near_.clear(), ends_.clear(), required_.clear(), foreign_.clear(), in_flight_.clear(),
      foreign_seen_.clear();
  handed_out_ = listed_ = 0;
  reader_.reset();
  map_.reset();
}

slvm::Result<bool> ScatterGrid::read_map(const std::string& name) {
  forget_grid();
  auto map = maps_.get(name);
  if (!map) return slvm::Error{map.error()};
  map_ = *map;
  reader_.emplace(map_->map());
  return true;
}

uint32_t ScatterGrid::add_grid_point(Vec3 P, float D) {
  constexpr size_t kMostListed = size_t{1} << 24;
  const auto index = static_cast<uint32_t>(ends_.size());
  const bool listed = listed_ == index && near_.size() < kMostListed;
  if (map_ && D > 0 && is_finite(P))
    reader_->for_each_within(P, D, [&](uint32_t sample, float) {
      if (listed) near_.push_back(sample);
      need(sample);
    });
  ends_.push_back(near_.size());
  listed_ += listed;
  return index;
}

void ScatterGrid::need(uint32_t sample) {
  switch (map_->claim(sample, owner_)) {
  case LitMap::Claim::kMine: required_.push_back(sample); break;
  case LitMap::Claim::kMineAlready:
  case LitMap::Claim::kLit: break;
  case LitMap::Claim::kOthers:
    if (foreign_seen_.insert(sample).second) foreign_.push_back(sample);
  }
}

bool ScatterGrid::next_sample(size_t& sample) {
  if (!required_.empty()) {
    sample = required_.front();
    required_.pop_front();
    return true;
  }
  while (!foreign_.empty()) {
    sample = foreign_.front();
    foreign_.pop_front();
    if (!map_->is_lit(sample)) return true;
  }
  // The pass is not full: some points have a sample and others would have none.
  return !ends_.empty() && handed_out_ % ends_.size() != 0 && map_->claim_any(owner_, sample);
}

bool ScatterGrid::get_sample(Vec3& P, Vec3& N, float& area) {
  size_t sample = 0;
  if (!map_ || !next_sample(sample)) return false;
  const ScatterSample found = reader_->sample(static_cast<uint32_t>(sample));
  P = found.position;
  N = found.normal;
  area = found.area;
  in_flight_.push_back(static_cast<uint32_t>(sample));
  ++handed_out_;
  return true;
}

void ScatterGrid::save_irradiance(Color irradiance) {
  if (in_flight_.empty()) return;
  map_->save(in_flight_.front(), irradiance);
  in_flight_.pop_front();
}

Color ScatterGrid::scatter(uint32_t index, Vec3 P, Vec3 N, float D, Color tint) const {
  Color sum;
  if (!map_ || index >= ends_.size() || !(D > 0)) return sum;
  auto add = [&](uint32_t i) {
    if (!map_->is_lit(i)) return; // the shader left the loop early
    const ScatterSample s = reader_->sample(i);
    const float weight = s.area * scatter_transmission(length(P - s.position), D) *
                         bounce_attenuation(P, s.position, N, s.normal, D);
    sum += map_->irradiance(i) * weight;
  };
  if (index >= listed_)
    reader_->for_each_within(P, D, [&](uint32_t sample, float) { add(sample); });
  else
    for (size_t k = index ? ends_[index - 1] : 0; k < ends_[index]; ++k)
      add(near_[k]);
  return sum * tint;
}

} // namespace subsurface
