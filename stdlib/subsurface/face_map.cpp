#include "stdlib/subsurface/face_map.h"

#include <algorithm>
#include <cassert>

namespace subsurface {
namespace {

/// Lists of near faces are made for distances in these steps, so that distances that vary share them.
constexpr int kStepsAnOctave = 2;
constexpr float kLeast = 1e-30f, kMost = 1e30f; // their squares are floats

int step_of(float D) {
  return static_cast<int>(std::ceil(std::log2(std::clamp(D, kLeast, kMost)) * kStepsAnOctave));
}
float distance_of(int step) {
  return std::exp2(static_cast<float>(step) / kStepsAnOctave);
}
float gap(float low, float high, float x) {
  return std::max({low - x, x - high, 0.0f});
}

} // namespace

float FaceBox::distance2(Vec3 x) const {
  return length2(Vec3{gap(low.x, high.x, x.x), gap(low.y, high.y, x.y), gap(low.z, high.z, x.z)});
}

float FaceBox::distance2(const FaceBox& other) const {
  Vec3 between;
  for (int c = 0; c < 3; ++c)
    between[c] = std::max({other.low[c] - high[c], low[c] - other.high[c], 0.0f});
  return length2(between);
}

FaceMap::FaceMap(std::span<const ScatterSample> samples, std::vector<uint32_t> starts,
                 std::shared_ptr<BlockPool> pool)
    : starts_(std::move(starts)), pool_(std::move(pool)) {
  assert(!starts_.empty() && starts_.back() == samples.size());
  std::vector<BlockPool::Block> blocks;
  for (size_t face = 0; face + 1 < starts_.size(); ++face) {
    const auto of_face = samples.subspan(starts_[face], starts_[face + 1] - starts_[face]);
    FaceBox box{of_face[0].position, of_face[0].position};
    BlockPool::Block block;
    for (const ScatterSample& s : of_face) {
      for (int c = 0; c < 3; ++c)
        box.low[c] = std::min(box.low[c], s.position[c]), box.high[c] = std::max(box.high[c], s.position[c]);
      block.insert(block.end(),
                   {s.position.x, s.position.y, s.position.z, s.normal.x, s.normal.y, s.normal.z, s.area});
    }
    boxes_.push_back(box);
    blocks.push_back(std::move(block));
  }
  first_block_ = pool_->add(std::move(blocks));
}

uint32_t FaceMap::face_of(uint32_t sample) const {
  return static_cast<uint32_t>(std::upper_bound(starts_.begin(), starts_.end(), sample) - starts_.begin()) -
         1;
}

uint32_t FaceMap::face_at(Vec3 x, uint32_t hint) const {
  if (boxes_[hint].distance2(x) == 0) return hint;
  uint32_t best = hint;
  float least = boxes_[hint].distance2(x);
  for (uint32_t face = 0; face < boxes_.size() && least > 0; ++face)
    if (const float d2 = boxes_[face].distance2(x); d2 < least) least = d2, best = face;
  return best;
}

std::span<const uint32_t> FaceMap::near(uint32_t face, float D) const {
  const Key key{step_of(D), face};
  {
    std::shared_lock lock(lists_mutex_);
    if (auto it = lists_.find(key); it != lists_.end()) return it->second;
  }
  const float reach = distance_of(key.first);
  std::vector<uint32_t> list;
  for (uint32_t other = 0; other < boxes_.size(); ++other)
    if (boxes_[face].distance2(boxes_[other]) <= reach * reach) list.push_back(other);
  list.shrink_to_fit();
  std::lock_guard lock(lists_mutex_);
  return lists_.emplace(key, std::move(list)).first->second; // whoever was first
}

size_t FaceMap::bytes() const {
  std::shared_lock lock(lists_mutex_);
  size_t sum = starts_.size() * sizeof(uint32_t) + boxes_.size() * sizeof(FaceBox);
  for (const auto& [key, list] : lists_)
    sum += sizeof(*lists_.begin()) + list.size() * sizeof(uint32_t);
  return sum;
}

const BlockPool::Block* FaceReader::read(uint32_t face) {
  auto [it, is_new] = held_.try_emplace(face);
  if (is_new) it->second = map_->samples(face);
  return it->second.get();
}

ScatterSample FaceReader::sample(uint32_t i) {
  const uint32_t face = map_->face_of(i);
  const BlockPool::Block* block = read(face);
  if (!block) return {};
  const size_t k = i - map_->first_sample(face);
  const float* n = block->data() + kNumbers * k;
  return {position(*block, k), {n[3], n[4], n[5]}, n[6]};
}

} // namespace subsurface
