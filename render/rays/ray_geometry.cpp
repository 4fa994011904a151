// Gathering primitives into items is in gather_items.cpp; here is what happens to items while rays are
// traced.
#include "render/rays/ray_geometry.h"

#include "render/prims/motion.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <set>

namespace render {

namespace {

/// Moments at which a moving item is made, at most.
constexpr int kMostMoments = 9;

/// Evenly apart from 0 to 1 so that all `keys` are among them, if that is possible.
std::vector<float> moments_of(const std::set<float>& keys) {
  int steps = 1;
  auto fits = [&](float key) {
    float at = key * static_cast<float>(steps);
    return std::abs(at - std::round(at)) < 1e-4f;
  };
  while (steps < kMostMoments - 1 && !std::all_of(keys.begin(), keys.end(), fits))
    ++steps;
  std::vector<float> out;
  for (int i = 0; i <= steps; ++i)
    out.push_back(static_cast<float>(i) / static_cast<float>(steps));
  return out;
}

} // namespace

RayGeometry::~RayGeometry() = default;

/// Called for the first ray that comes to an item, and again when the world forgot.
const FaceScene* RayGeometry::faces(uint32_t index) {
  Item& item = *items_[items_[index]->model];
  uint64_t now = clock_.load(std::memory_order_relaxed);
  if (item.used.load(std::memory_order_relaxed) != now) item.used.store(now, std::memory_order_relaxed);
  if (const FaceScene* ready = item.ready.load(std::memory_order_acquire)) return ready;
  if (item.made.load(std::memory_order_acquire)) return nullptr;
  std::lock_guard lock(item.making);
  if (!item.made) make(item);
  return item.ready;
}

void RayGeometry::make(Item& item) {
  std::vector<float> moments{0};
  if (item.traits.moving) {
    std::set<float> keys;
    for (const ItemPart& part : item.parts->list)
      for (float t : motion_times(scene_.primitives[item.first_primitive + part.primitive]))
        keys.insert(t);
    if (!keys.empty()) moments = moments_of(keys);
  }
  std::vector<QuadMesh> parts;
  parts.reserve(item.parts->list.size());
  for (size_t i = 0; i < item.parts->list.size(); ++i)
    tessellate(scene_.primitives[item.first_primitive + item.parts->list[i].primitive], item.parts->rates[i],
               displacer_, moments, item.placed ? &item.to_object : nullptr, parts);
  item.faces = device_.build(joined(parts, moments.size()));
  ++made_;
  faces_ += item.parts->faces;
  item.ready.store(item.faces.get(), std::memory_order_release);
  item.made.store(true, std::memory_order_release);
}

void PartIndex::build(std::span<const ItemPart> parts, uint32_t faces) {
  const auto count = static_cast<uint32_t>(parts.size());
  // About as many blocks as parts.
  shift_ = std::bit_width(std::max(faces / std::max(count, 1u), 1u)) - 1;
  uint32_t part = 0;
  for (uint64_t face = 0; face < faces; face += uint64_t{1} << shift_) {
    while (part + 1 < count && parts[part + 1].first_face <= face)
      ++part;
    first_.push_back(part);
  }
  first_.push_back(count - 1);
}

size_t PartIndex::find(std::span<const ItemPart> parts, uint32_t face) const {
  const size_t block = face >> shift_;
  assert(block + 1 < first_.size());
  size_t low = first_[block], high = first_[block + 1];
  while (low < high) {
    const size_t middle = (low + high + 1) / 2;
    if (parts[middle].first_face <= face)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

uint32_t RayGeometry::primitive(const RayHit& hit) const {
  return primitive_of(*items_[hit.item], hit.face);
}

SurfacePlace RayGeometry::place(const RayHit& hit) {
  const Item& item = *items_[hit.item];
  const ItemPart& part = item.parts->list[item.parts->find(hit.face)];
  const uint32_t face = hit.face - part.first_face, row = face >> part.log_u,
                 column = face & ((1u << part.log_u) - 1);
  auto parameter = [](uint32_t whole, float rest, uint8_t log) {
    const float face_size = std::bit_cast<float>((127u - log) << 23); // 2^-log
    return std::clamp((static_cast<float>(whole) + rest) * face_size, 0.0f, 1.0f);
  };
  const FaceScene* made = items_[item.model]->ready.load(std::memory_order_acquire);
  const Vec2 at = (made ? made : faces(hit.item))->on_patch(hit);
  return {item.first_primitive + part.primitive, parameter(column, at.x, part.log_u),
          parameter(row, at.y, part.log_v), part.displaced};
}

/// The patches of one request are one surface.
bool RayGeometry::same_surface(uint32_t index, uint32_t face, uint32_t other) const {
  const Item& item = *items_[index];
  return &state_of(item, face) == &state_of(item, other);
}

RayOpacity RayGeometry::shadow(const RayHit& hit) const {
  const Item& item = *items_[hit.item];
  return item.solid ? state_of(item, hit.face).attributes->rays.shadow() : item.traits.shadow;
}

namespace {

/// A subset names groups that are seen, or, with "-", groups that are not; with only the latter all others
/// are.
bool is_in(std::string_view groups, std::string_view subset) {
  std::vector<std::string_view> members = words_of(groups);
  bool wanted = false, any_wanted = false;
  for (std::string_view word : words_of(subset)) {
    bool without = word[0] == '-';
    if (word[0] == '-' || word[0] == '+') word.remove_prefix(1);
    bool member = std::find(members.begin(), members.end(), word) != members.end();
    if (without && member) return false;
    any_wanted = any_wanted || !without;
    wanted = wanted || (!without && member);
  }
  return wanted || !any_wanted;
}

bool is_visible(slvm::RayKind kind, bool specular, bool diffuse, RayOpacity shadow) {
  switch (kind) {
  case slvm::RayKind::kSpecular: return specular;
  case slvm::RayKind::kDiffuse: return diffuse;
  case slvm::RayKind::kTransmission: return shadow != RayOpacity::kTransparent;
  }
  return false;
}

} // namespace

void RayGeometry::find_seen(slvm::RayKind kind, std::string_view subset, Seen& out) const {
  out.items.resize(items_.size() + 1); // never without data
  for (size_t i = 0; i < items_.size(); ++i) {
    const RayTraits& t = items_[i]->traits;
    if (!items_[i]->solid) {
      out.items[i] = is_visible(kind, t.specular, t.diffuse, t.shadow) && is_in(groups_[t.groups], subset);
      continue;
    }
    out.surfaces.resize(scene_.primitives.runs().size());
    for (const ItemPart& part : items_[i]->parts->list) {
      const size_t run = scene_.primitives.run_number(items_[i]->first_primitive + part.primitive);
      const RayAttributes& a = scene_.primitives.runs()[run].attributes().rays;
      const bool seen = is_visible(kind, is_specular(a), a.diffuse, a.shadow()) && is_in(a.groups, subset);
      out.surfaces[run] = seen;
      out.items[i] = out.items[i] || seen;
    }
  }
}

RayRule RayGeometry::rule(slvm::RayKind kind, std::string_view subset, slvm::HitSides sides) {
  std::lock_guard lock(seen_mutex_);
  auto [it, is_new] = seen_.try_emplace({kind, std::string(subset)});
  if (is_new) find_seen(kind, subset, it->second);
  return {it->second.items.data(), it->second.surfaces.data(), sides};
}

void RayGeometry::trim() {
  const uint64_t now = clock_.fetch_add(1, std::memory_order_relaxed);
  const size_t enough = settings_.most_bytes / 4 * 3;
  // Which faces are in use is asked now and then from when some may have to go.
  if (device_.bytes() > enough && now % 16 == 0) world_->forget_faces();
  if (device_.bytes() <= settings_.most_bytes) return;
  std::unique_lock lock(gate_);
  world_->forget_faces();
  std::vector<std::pair<uint64_t, Item*>> all;
  for (const auto& item : items_)
    if (item->faces) all.emplace_back(item->used.load(), item.get());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // Well below the limit, or the next rays would be here again. What was used last stays, however large.
  for (size_t i = 0; i + 1 < all.size() && device_.bytes() > enough; ++i) {
    Item& item = *all[i].second;
    item.ready = nullptr;
    item.made = false;
    item.faces.reset();
    ++dropped_;
  }
}

RayGeometryUsage RayGeometry::usage() const {
  return {device_.bytes(), made_, dropped_, faces_};
}

} // namespace render
