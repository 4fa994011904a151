#include "render/rays/hit_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <string>

namespace render {

/// Groups by what makes them.
struct HitGroups::Numbers {
  struct Key {
    /// Shaders and lights; or, where they may ask for more, whose attributes and which object space these
    /// are.
    std::vector<const void*> shading;
    std::array<float, 16> object{};
    std::array<float, 8> texture_coordinates;
    bool flipped;
    RayAttributes rays;
    std::string variables;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, uint32_t> known;

  static Key key_of(const Primitive& p, const BoundAttributes& bound);
  static std::string variables_of(const Primitive& p);
};

namespace {

/// Whether a shader can tell one object from another by more than what its points are given.
bool looks_at_object(const slvm::Instance* instance) {
  if (!instance) return false;
  const slvm::Program& p = instance->program();
  auto has = [](const auto& list, auto&& what) { return std::any_of(list.begin(), list.end(), what); };
  return has(p.imports,
             [&](slvm::ShadeopId id) {
               return p.plugins.find(id) || p.plugins.info(id).name == "attribute";
             }) ||
         has(p.strings, [](const std::string& s) { return s == "object"; }) ||
         has(p.slots, [](const slvm::Slot& s) { return s.type == slvm::Type::kString; });
}

} // namespace

HitGroups::Numbers::Key HitGroups::Numbers::key_of(const Primitive& p, const BoundAttributes& bound) {
  const Attributes& a = p.attributes();
  Key key;
  const slvm::ShaderSet& set = bound.shaders;
  std::vector<const slvm::Instance*> all{set.displacement, set.surface, set.atmosphere, set.interior,
                                         set.exterior};
  all.insert(all.end(), bound.lights.begin(), bound.lights.end());
  if (!a.scoped_spaces.empty() || std::any_of(all.begin(), all.end(), looks_at_object)) {
    key.shading = {&a};
    key.object = p.state->object_to_camera.m;
  } else {
    key.shading.assign(all.begin(), all.end());
  }
  key.texture_coordinates = a.texture_coordinates;
  key.flipped = a.flips_normals(p.state->mirrored);
  key.rays = a.rays;
  key.variables = variables_of(p);
  return key;
}

std::string HitGroups::Numbers::variables_of(const Primitive& p) {
  std::string out;
  for (const PatchVar& var : p.vars) {
    out += var.name;
    out += static_cast<char>('a' + static_cast<int>(var.type));
    out += std::to_string(var.elements);
    out += static_cast<char>('0' + static_cast<int>(var.interpolation));
    if (var.interpolation != Interpolation::kConstant || replaced_variable(var) != slvm::Global::kCount)
      continue;
    out.append(reinterpret_cast<const char*>(var.values.data()), var.values.size() * sizeof(float));
    for (const std::string& s : var.strings)
      out += s + '\0';
  }
  return out;
}

HitGroups::HitGroups(const Scene& scene, const BoundShaders& shaders)
    : scene_(scene), shaders_(shaders), of_run_(scene.primitives.runs().size()),
      numbers_(std::make_unique<Numbers>()) {}

HitGroups::~HitGroups() = default;

size_t HitGroups::count() const {
  return numbers_->known.size();
}

/// With the lock.
uint32_t HitGroups::group_of(uint32_t primitive) {
  const size_t number = scene_.primitives.run_number(primitive);
  const PrimitiveList::Run& run = scene_.primitives.runs()[number];
  uint32_t& known = run.pieces->vars_are_alike() ? of_run_[number] : of_primitive_[primitive];
  if (known) return known;
  const Primitive p = run.primitive(primitive - run.first);
  Numbers::Key key = Numbers::key_of(p, *shaders_.find(&p.attributes()));
  auto [it, is_new] = numbers_->known.try_emplace(std::move(key), 0);
  // What was hit first decides the number: the order of groups changes no result.
  if (is_new) it->second = static_cast<uint32_t>(numbers_->known.size());
  return known = it->second;
}

/// Returns how many groups there are.
size_t HitOrder::fill_buckets(std::span<const HitRay> hits, HitGroups& groups) {
  buckets_.clear();
  bucket_of_.resize(hits.size());
  const size_t places = std::bit_ceil(2 * hits.size());
  table_.assign(places, kNone);
  auto find = [&](uint32_t primitive) {
    size_t place = (primitive * 0x9e3779b9u) & (places - 1);
    while (table_[place] != kNone && buckets_[table_[place]].primitive != primitive)
      place = (place + 1) & (places - 1);
    if (table_[place] == kNone) {
      table_[place] = static_cast<uint32_t>(buckets_.size());
      buckets_.push_back({primitive, groups.group_of(primitive)});
    }
    return table_[place];
  };
  std::lock_guard lock(groups.mutex_);
  for (size_t i = 0; i < hits.size(); ++i) {
    const uint32_t primitive = hits[i].place.primitive;
    const bool again = i > 0 && primitive == hits[i - 1].place.primitive;
    bucket_of_[i] = again ? bucket_of_[i - 1] : find(primitive);
    ++buckets_[bucket_of_[i]].count;
  }
  return groups.count();
}

std::span<const HitRay> HitOrder::sort(std::span<const HitRay> hits, HitGroups& groups) {
  group_ends_.clear();
  if (hits.empty()) return hits;
  const size_t count = fill_buckets(hits, groups);
  if (buckets_.size() == 1) {
    group_ends_.push_back(hits.size());
    return hits;
  }
  // Groups in the order of their first hits.
  in_groups_.resize(buckets_.size());
  std::iota(in_groups_.begin(), in_groups_.end(), 0u);
  std::vector<uint32_t>& first_of = table_; // first bucket of each group; numbers of groups begin at 1
  first_of.assign(count + 1, kNone);
  for (uint32_t k = 0; k < buckets_.size(); ++k)
    if (first_of[buckets_[k].group] == kNone) first_of[buckets_[k].group] = k;
  std::sort(in_groups_.begin(), in_groups_.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(first_of[buckets_[a].group], a) < std::pair(first_of[buckets_[b].group], b);
  });
  uint32_t place = 0, last = buckets_[in_groups_[0]].group;
  for (uint32_t k : in_groups_) {
    Bucket& bucket = buckets_[k];
    if (bucket.group != last) group_ends_.push_back(place);
    last = bucket.group;
    bucket.first = place;
    place += bucket.count;
  }
  group_ends_.push_back(hits.size());
  in_order_.resize(hits.size());
  for (size_t i = 0; i < hits.size(); ++i)
    in_order_[buckets_[bucket_of_[i]].first++] = hits[i];
  return in_order_;
}

} // namespace render
