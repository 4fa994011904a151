// Records of irradiance caches: merged, and as tables.
#include "render/caches/irradiance_cache.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace render {

namespace {

constexpr const char* kKind = "irradiance cache";
constexpr uint32_t kAll =
    kOcclusion | kIrradiance | kEnvironmentColour | kEnvironmentDirection | kSurroundings;

/// Values of a sample that belong together, by their columns' name.
struct Group {
  const char* name;
  CacheValue held;
  uint32_t first, count;
};
constexpr Group kGroups[] = {{"occlusion", kOcclusion, 0, 1},
                             {"irradiance", kIrradiance, 1, 3},
                             {"environmentcolor", kEnvironmentColour, 4, 3},
                             {"environmentdir", kEnvironmentDirection, 7, 3}};

bool has_gradients(const Group& g) {
  return g.first < HemisphereSample::kGradients;
}

// ---- Merging.

std::weak_ordering order_of(Vec3 a, Vec3 b) {
  for (int c = 0; c < 3; ++c)
    if (a[c] != b[c]) return a[c] < b[c] ? std::weak_ordering::less : std::weak_ordering::greater;
  return std::weak_ordering::equivalent;
}

/// By place, then by all that they hold, so that sums do not depend on the order in which records came.
std::weak_ordering order_of(const IrradianceRecord& a, const IrradianceRecord& b) {
  if (auto o = order_of(a.P, b.P); o != 0) return o;
  if (auto o = order_of(a.N, b.N); o != 0) return o;
  return a.holds <=> b.holds;
}
bool less_by_contents(const IrradianceRecord& a, const IrradianceRecord& b) {
  if (a.radius != b.radius) return a.radius < b.radius;
  return std::memcmp(&a.sample, &b.sample, sizeof a.sample) < 0;
}
bool same_place(const IrradianceRecord& a, const IrradianceRecord& b) {
  return a.P == b.P && a.N == b.N;
}

/// One record of several at the same place.
IrradianceRecord mean_of_records(std::span<const IrradianceRecord* const> all) {
  IrradianceRecord out = *all.front();
  for (const IrradianceRecord* r : all)
    out.radius = std::max(out.radius, r->radius);
  auto of_those = [&](CacheValue held, auto&& take) {
    std::vector<HemisphereSample> samples;
    for (const IrradianceRecord* r : all)
      if (r->holds & held) samples.push_back(r->sample);
    if (samples.empty()) return;
    out.holds |= held;
    take(mean_of(samples));
  };
  for (const Group& g : kGroups)
    of_those(g.held, [&](const HemisphereSample& mean) {
      std::copy_n(mean.value.begin() + g.first, g.count, out.sample.value.begin() + g.first);
      if (!has_gradients(g)) return;
      std::copy_n(mean.move.begin() + g.first, g.count, out.sample.move.begin() + g.first);
      std::copy_n(mean.turn.begin() + g.first, g.count, out.sample.turn.begin() + g.first);
    });
  of_those(kSurroundings, [&](const HemisphereSample& mean) { out.sample.distance = mean.distance; });
  return out;
}

// ---- Tables.

Vec3 triple_at(const PointColumn& c, size_t i) {
  return {c.values[3 * i], c.values[3 * i + 1], c.values[3 * i + 2]};
}

void put_triple(std::vector<float>& to, size_t at, Vec3 v) {
  for (size_t c = 0; c < 3; ++c)
    to[at + c] = v[static_cast<int>(c)];
}

/// Columns of one group, of those records that hold it.
void put_group(PointTable& table, std::span<const IrradianceRecord> records, const Group& g, bool gradients) {
  std::vector<float> values(g.count * records.size()), move, turn;
  gradients = gradients && has_gradients(g);
  if (gradients) {
    move.resize(3 * values.size());
    turn.resize(3 * values.size());
  }
  for (size_t i = 0; i < records.size(); ++i)
    for (size_t k = 0; k < g.count && records[i].holds & g.held; ++k) {
      const HemisphereSample& s = records[i].sample;
      const size_t at = g.count * i + k;
      values[at] = s.value[g.first + k];
      if (!gradients) continue;
      put_triple(move, 3 * at, s.move[g.first + k]);
      put_triple(turn, 3 * at, s.turn[g.first + k]);
    }
  table.add(g.name, g.count) = std::move(values);
  if (!gradients) return;
  table.add(fmt::format("{}_move", g.name), 3 * g.count) = std::move(move);
  table.add(fmt::format("{}_turn", g.name), 3 * g.count) = std::move(turn);
}

void take_group(const PointTable& table, std::span<IrradianceRecord> records, const Group& g) {
  const PointColumn* values = table.find(g.name, g.count);
  const PointColumn* move = table.find(fmt::format("{}_move", g.name), 3 * g.count);
  const PointColumn* turn = table.find(fmt::format("{}_turn", g.name), 3 * g.count);
  for (size_t i = 0; i < records.size(); ++i) {
    IrradianceRecord& r = records[i];
    if (!values) r.holds &= ~static_cast<uint32_t>(g.held);
    for (size_t k = 0; k < g.count && values; ++k) {
      const size_t at = g.count * i + k;
      r.sample.value[g.first + k] = values->values[at];
      if (!has_gradients(g) || !move || !turn) continue;
      r.sample.move[g.first + k] = triple_at(*move, at);
      r.sample.turn[g.first + k] = triple_at(*turn, at);
    }
  }
}

} // namespace

std::vector<IrradianceRecord> merged(std::vector<IrradianceRecord> records, size_t older) {
  std::vector<size_t> order(records.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (auto o = order_of(records[a].P, records[b].P); o != 0) return o < 0;
    if (auto o = order_of(records[a].N, records[b].N); o != 0) return o < 0;
    if ((a < older) != (b < older)) return b < older; // newer ones first
    if (auto o = order_of(records[a], records[b]); o != 0) return o < 0;
    return less_by_contents(records[a], records[b]);
  });
  std::vector<IrradianceRecord> out;
  std::vector<const IrradianceRecord*> group;
  for (size_t i = 0; i < order.size();) {
    const IrradianceRecord& first = records[order[i]];
    const bool is_old = order[i] < older;
    group.clear();
    for (; i < order.size() && same_place(first, records[order[i]]); ++i)
      if ((order[i] < older) == is_old) group.push_back(&records[order[i]]);
    out.push_back(group.size() == 1 ? first : mean_of_records(group));
  }
  return out;
}

PointTable table_of(std::span<const IrradianceRecord> records) {
  PointTable table;
  table.kind = kKind;
  table.points = records.size();
  uint32_t holds = 0;
  std::vector<float> P(3 * records.size()), N(3 * records.size()), radius, held, nearness;
  for (const IrradianceRecord& r : records) {
    put_triple(P, 3 * radius.size(), r.P);
    put_triple(N, 3 * radius.size(), r.N);
    radius.push_back(r.radius);
    held.push_back(static_cast<float>(r.holds));
    nearness.push_back(r.holds & kSurroundings ? 1 / r.sample.distance : 0);
    holds |= r.holds;
  }
  table.add("P", 3) = std::move(P);
  table.add("N", 3) = std::move(N);
  table.add("radius", 1) = std::move(radius);
  table.add("holds", 1) = std::move(held);
  if (holds & kSurroundings) table.add("nearness", 1) = std::move(nearness);
  for (const Group& g : kGroups)
    if (holds & g.held) put_group(table, records, g, holds & kSurroundings);
  return table;
}

slvm::Result<std::vector<IrradianceRecord>> records_of(const PointTable& table, const std::string& name) {
  if (table.kind != kKind)
    return slvm::Error{fmt::format("{}: this is a {}, not an {}", name, table.kind, kKind)};
  const PointColumn *P = table.find("P", 3), *N = table.find("N", 3), *radius = table.find("radius", 1),
                    *holds = table.find("holds", 1), *nearness = table.find("nearness", 1);
  if (!P || !N || !radius || !holds)
    return slvm::Error{
        fmt::format("{}: the {} has no places: it needs columns P, N, radius and holds", name, kKind)};
  std::vector<IrradianceRecord> out(table.points);
  for (size_t i = 0; i < out.size(); ++i) {
    IrradianceRecord& r = out[i];
    r.P = triple_at(*P, i);
    r.N = triple_at(*N, i);
    r.radius = radius->values[i];
    const float held = holds->values[i], near = nearness ? nearness->values[i] : 0;
    if (std::abs(glm::length(r.N) - 1) > 1e-3f || !(r.radius >= 0) || !(held >= 0) || held > kAll ||
        held != std::floor(held) || !(near >= 0))
      return slvm::Error{fmt::format("{}: point {} of the {} cannot be", name, i, kKind)};
    r.holds = static_cast<uint32_t>(held);
    if (!nearness) r.holds &= ~static_cast<uint32_t>(kSurroundings);
    r.sample.distance = near > 0 ? 1 / near : kInfinity;
  }
  for (const Group& g : kGroups)
    take_group(table, out, g);
  return out;
}

} // namespace render
