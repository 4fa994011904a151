// Finding, adding and weighing records.
#include "render/rays/hemisphere_records.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

/// Samples in front of a point, by this part of their distance, see something else.
constexpr float kInFront = 0.05f;
/// How much less far records reach where they foretold wrongly.
constexpr float kShrink = 0.5f;

/// Ward's estimate of the error, of which 1 is the whole value.
float error_of(Vec3 from, Vec3 normal, float reach, Vec3 P, Vec3 N) {
  return glm::distance(from, P) / reach + std::sqrt(std::max(0.0f, 1 - glm::dot(normal, N)));
}

bool agree(const HemisphereSample& a, const HemisphereSample& b, float tolerance) {
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c) {
    float whole = c == 0 ? 1.0f : std::max({a.value[c], b.value[c], 0.1f});
    if (!(std::abs(a.value[c] - b.value[c]) <= tolerance * whole)) return false;
  }
  return true;
}

int level_of(float reach) {
  return static_cast<int>(std::ceil(std::log2(std::max(reach, 1e-12f))));
}

} // namespace

size_t HemisphereRecords::Hash::operator()(const Cell& c) const {
  uint64_t h = c.call;
  for (int32_t x : {c.level, c.x, c.y, c.z}) {
    h = (h ^ static_cast<uint32_t>(x)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 29;
  }
  return static_cast<size_t>(h);
}

/// f(record) for all records that may reach P.
template <class F> void HemisphereRecords::near(const RecordRule& rule, Vec3 P, F&& f) {
  for (int level = kLowest; level <= kHighest; ++level) {
    if (!used_[static_cast<size_t>(level - kLowest)].load(std::memory_order_acquire)) continue;
    float side = std::ldexp(1.0f, level);
    auto at = [&](float x) { return static_cast<int32_t>(std::floor(std::clamp(x / side, -1e9f, 1e9f))); };
    Cell cell{rule.call, level, at(P.x), at(P.y), at(P.z)};
    Shard& shard = shard_of(cell);
    std::shared_lock lock(shard.mutex);
    auto it = shard.cells.find(cell);
    if (it == shard.cells.end()) continue;
    for (Record* r : it->second)
      f(*r);
  }
}

std::optional<HemisphereSample> HemisphereRecords::find(const RecordRule& rule, Vec3 P, Vec3 N) {
  HemisphereSample sum;
  float weights = 0, nearness = 0;
  near(rule, P, [&](const Record& r) {
    float reach = r.reach.load(std::memory_order_relaxed);
    float error = error_of(r.P, r.N, reach, P, N);
    if (!(error < rule.max_error) || glm::dot(P - r.P, N + r.N) < -kInFront * reach) return;
    float weight = 1 / std::max(error, 1e-3f) - 1 / rule.max_error; // falls to 0 at the edge
    const HemisphereSample here = carried(r.sample, P - r.P, glm::cross(r.N, N));
    for (size_t c = 0; c < HemisphereSample::kValues; ++c)
      sum.value[c] += weight * here.value[c];
    nearness += weight / r.sample.distance;
    weights += weight;
  });
  if (!(weights > 0)) return {};
  for (float& value : sum.value)
    value /= weights;
  sum.distance = weights / nearness;
  return sum;
}

void HemisphereRecords::add(const RecordRule& rule, Vec3 P, Vec3 N, const HemisphereSample& sample) {
  if (count_.load(std::memory_order_relaxed) >= kMost) return;
  const float least = rule.nearest / rule.max_error, most = rule.farthest / rule.max_error;
  float reach = reach_of(sample);
  near(rule, P, [&](Record& r) {
    float other = r.reach.load(std::memory_order_relaxed), way = glm::distance(r.P, P);
    if (way > other * rule.max_error) return;
    const HemisphereSample foretold = carried(r.sample, P - r.P, glm::cross(r.N, N));
    bool applies = error_of(r.P, r.N, other, P, N) < rule.max_error;
    if (applies && !agree(foretold, sample, rule.tolerance)) other *= kShrink;
    other = std::min(other, reach + way);
    r.reach.store(std::max(other, least), std::memory_order_relaxed);
    reach = std::min(reach, other + way);
  });
  reach = std::clamp(reach, least, most);
  if (!(reach > 0) || !std::isfinite(reach)) return;
  const float radius = reach * rule.max_error;
  const int level = std::clamp(level_of(2 * radius), kLowest, kHighest);
  const float side = std::ldexp(1.0f, level);
  auto at = [&](float x) { return static_cast<int32_t>(std::floor(std::clamp(x / side, -1e9f, 1e9f))); };
  const Vec3 low = P - radius, high = P + radius;
  Record* record = nullptr;
  for (int32_t z = at(low.z); z <= at(high.z); ++z)
    for (int32_t y = at(low.y); y <= at(high.y); ++y)
      for (int32_t x = at(low.x); x <= at(high.x); ++x) {
        Cell cell{rule.call, level, x, y, z};
        Shard& shard = shard_of(cell);
        std::lock_guard lock(shard.mutex);
        if (!record) record = &shard.records.emplace_back(P, N, sample, reach);
        shard.cells[cell].push_back(record);
      }
  ++count_;
  used_[static_cast<size_t>(level - kLowest)].store(true, std::memory_order_release);
}

} // namespace render
