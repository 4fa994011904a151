// From the primitives of a scene to the items of its ray geometry.
#include "render/rays/ray_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace render {

namespace {

/// Boxes beyond are of scenes gone wrong; Embree's limit is about 1e18.
constexpr float kFarthest = 1e17f;

bool is_usable(const Box& box) {
  return !box.empty() && glm::all(glm::lessThan(glm::abs(box.min), Vec3(kFarthest))) &&
         glm::all(glm::lessThan(glm::abs(box.max), Vec3(kFarthest)));
}

bool nearly_equal(const Matrix4& a, const Matrix4& b) {
  for (size_t i = 0; i < 16; ++i)
    if (!(std::abs(a.m[i] - b.m[i]) <= 1e-5f * std::max(1.0f, std::abs(a.m[i])))) return false;
  return true;
}

/// Whether two geometries are the same surface, as far as a few points tell.
bool same_geometry(const Geometry& a, const Geometry& b) {
  constexpr float kProbes[] = {0, 0.37f, 0.71f, 1};
  SurfaceLattice x, y;
  a.find_points({kProbes, kProbes}, x);
  b.find_points({kProbes, kProbes}, y);
  return x.P == y.P;
}

} // namespace

/// Fills the items of a RayGeometry.
class RayGeometry::Gatherer {
public:
  Gatherer(RayGeometry& out, const Camera& camera)
      : out_(out), primitives_(out.scene_.primitives), runs_(primitives_.runs()), camera_(camera),
        most_faces_(
            std::min(out.settings_.item_faces, out.settings_.most_bytes / (kLeastItems * kBytesOfFace))) {}

  void run() {
    for (const Run& r : runs_)
      sampled_ = sampled_ || r.attributes().rays.sample_motion;
    find_visible();
    gather_copies();
    find_singles();
    for (auto& [traits, list] : by_traits_)
      split(traits, list.begin(), list.end());
    for (auto& [tree, list] : solids_)
      add_solid(tree, list);
  }

private:
  using Run = PrimitiveList::Run;
  /// An instance of an object: these runs.
  struct Copy {
    size_t first = 0, end = 0;
    Matrix4 to_camera;
  };
  using Copies = std::vector<Copy>;
  /// A primitive that is no part of an instance.
  struct Single {
    uint32_t primitive = 0;
    Box bounds;
  };
  using List = std::vector<uint32_t>; ///< of singles

  RayTraits traits_of(const Run&);
  bool is_displaced(const Run& r) const { return is_displaced_for_rays(r.primitive(0), out_.displacer_); }
  void find_visible();
  std::vector<Copies> find_copies() const;
  bool same_as_first(const Copy& copy, const Copy& first) const;
  bool can_be_shared(const Copy&) const;
  bool is_taken(const Copy& c) const {
    return std::any_of(taken_.begin() + static_cast<std::ptrdiff_t>(c.first),
                       taken_.begin() + static_cast<std::ptrdiff_t>(c.end), [](uint8_t t) { return t != 0; });
  }
  void gather_copies();
  std::vector<float> fineness(const Copy&) const;
  std::vector<FaceRate> rates_of(const Copies&) const;
  template <class F> void for_each_request(size_t first, size_t end, F&& f) const;
  void find_singles();
  void split(const RayTraits& traits, List::iterator begin, List::iterator end);
  void add_solid(const std::shared_ptr<const SolidTree>& tree, const List& list);
  Item& add(const RayTraits& traits, const List& list);
  Item& add(const RayTraits& traits, std::shared_ptr<const ItemParts> parts, const Box& bounds);

  RayGeometry& out_;
  const PrimitiveList& primitives_;
  std::span<const Run> runs_;
  const Camera& camera_;
  /// Items are dropped one by one: so many have to fit into the memory there is.
  static constexpr size_t kLeastItems = 4, kBytesOfFace = 160;
  size_t most_faces_;
  bool sampled_ = false;          ///< some rays see motion
  std::vector<uint8_t> seen_;     ///< by run
  std::vector<RayTraits> traits_; ///< by run
  std::vector<uint8_t> taken_;    ///< by run: is part of an instance
  std::vector<Single> singles_;
  std::vector<FaceRate> rates_; ///< of these
  std::map<RayTraits, List> by_traits_;
  struct ByNumber {
    bool operator()(const auto& a, const auto& b) const { return a->number() < b->number(); }
  };
  std::map<std::shared_ptr<const SolidTree>, List, ByNumber> solids_;
  std::unordered_map<std::string, uint32_t> group_numbers_;
};

namespace {

size_t count_of(std::span<const PrimitiveList::Run> request) {
  return size_t{request.back().first} + request.back().count - request.front().first;
}

/// Lists the parts of an item: add() each.
class PartLister {
public:
  void add(uint32_t primitive, const FaceRate& rate, bool displaced) {
    auto log = [](int n) { return static_cast<uint8_t>(std::countr_zero(static_cast<unsigned>(n))); };
    parts_->list.push_back({primitive, parts_->faces, log(rate.u), log(rate.v), displaced});
    parts_->rates.push_back(rate);
    parts_->faces += static_cast<uint32_t>(rate.faces());
  }
  std::shared_ptr<const ItemParts> take() {
    parts_->index.build(parts_->list, parts_->faces);
    return std::move(parts_);
  }

private:
  std::shared_ptr<ItemParts> parts_ = std::make_shared<ItemParts>();
};

} // namespace

RayTraits RayGeometry::Gatherer::traits_of(const Run& r) {
  const Attributes& a = r.attributes();
  RayTraits t;
  t.specular = out_.is_specular(a.rays);
  t.diffuse = a.rays.diffuse;
  t.shadow = a.rays.shadow();
  t.one_sided = a.sides == 1;
  t.flipped = a.flips_normals(r.state->mirrored);
  t.moving = sampled_ && r.moves();
  auto [it, is_new] = group_numbers_.try_emplace(a.rays.groups, static_cast<uint32_t>(out_.groups_.size()));
  if (is_new) out_.groups_.push_back(a.rays.groups);
  t.groups = it->second;
  return t;
}

void RayGeometry::Gatherer::find_visible() {
  seen_.resize(runs_.size());
  traits_.resize(runs_.size());
  taken_.resize(runs_.size());
  for (size_t i = 0; i < runs_.size(); ++i) {
    const Run& r = runs_[i];
    // Of the two versions of an object between two levels of detail, rays see the one that most samples do.
    // What is cut out of a solid is so whether rays see it or not.
    seen_[i] = (r.state->solid || out_.is_seen_at_all(r.attributes().rays)) && r.state->level.has(0.5f);
    if (seen_[i]) traits_[i] = traits_of(r);
  }
}

bool RayGeometry::Gatherer::can_be_shared(const Copy& copy) const {
  for (size_t i = copy.first; i < copy.end; ++i) {
    const Run& r = runs_[i];
    if (!seen_[i] || r.state->solid || (sampled_ && r.moves()) || traits_[i] != traits_[copy.first] ||
        is_displaced(r) || !is_usable(r.camera_bound()))
      return false;
  }
  return true;
}

/// The same surfaces in the same place of the object.
bool RayGeometry::Gatherer::same_as_first(const Copy& copy, const Copy& first) const {
  if (copy.end - copy.first != first.end - first.first) return false;
  Matrix4 a = inverse_or_identity(copy.to_camera), b = inverse_or_identity(first.to_camera);
  for (size_t i = 0; i < copy.end - copy.first; ++i) {
    const Run &r = runs_[copy.first + i], &q = runs_[first.first + i];
    if (r.count != q.count || !nearly_equal(r.state->object_to_camera * a, q.state->object_to_camera * b))
      return false;
    for (uint32_t k = 0; k < r.count && r.pieces != q.pieces; ++k)
      if (!same_geometry(*r.primitive(k).geometry, *q.primitive(k).geometry)) return false;
  }
  return true;
}

/// Copies of recorded objects, and of meshes that are there more than once. Of those that begin with the same
/// surfaces the largest comes first.
std::vector<RayGeometry::Gatherer::Copies> RayGeometry::Gatherer::find_copies() const {
  std::vector<Copies> all;
  std::map<std::pair<const void*, size_t>, size_t> numbers; // of objects of so many runs
  auto add = [&](const void* object, const Copy& copy) {
    auto [it, is_new] = numbers.try_emplace({object, copy.end - copy.first}, all.size());
    if (is_new) all.emplace_back();
    all[it->second].push_back(copy);
  };
  for (const ObjectCopy& c : out_.scene_.copies)
    if (c.count > 0 && c.first + c.count <= primitives_.size())
      add(c.object,
          {primitives_.run_number(c.first), primitives_.run_number(c.first + c.count - 1) + 1, c.to_camera});
  for (size_t i = 0; i < runs_.size(); ++i)
    if (runs_[i].pieces.use_count() > 1)
      add(runs_[i].pieces.get(), {i, i + 1, runs_[i].state->object_to_camera});
  for (Copies& copies : all) {
    if (copies.size() > 1) std::erase_if(copies, [&](const Copy& c) { return !can_be_shared(c); });
    if (copies.size() > 1) {
      const Copy first = copies.front();
      std::erase_if(copies, [&](const Copy& c) { return !same_as_first(c, first); });
    }
  }
  std::erase_if(all, [](const Copies& copies) { return copies.size() < 2; });
  std::stable_sort(all.begin(), all.end(), [](const Copies& a, const Copies& b) {
    return a[0].first != b[0].first ? a[0].first < b[0].first : a[0].end > b[0].end;
  });
  return all;
}

/// How fine the faces of each block of a copy have to be, in the sizes of the object.
std::vector<float> RayGeometry::Gatherer::fineness(const Copy& copy) const {
  std::vector<float> out;
  for (size_t i = copy.first; i < copy.end; ++i) {
    const Run& r = runs_[i];
    float longest = 0;
    for (Vec3 axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      longest = std::max(longest, glm::length(transform_vector(r.state->object_to_camera, axis)));
    for (size_t b = 0; b < r.pieces->blocks().size(); ++b)
      out.push_back(longest * fineness_in(r.camera_bound(b), camera_, r.attributes()));
  }
  return out;
}

/// Rates of all primitives of an object, as finely as the finest of its copies needs it: each block is
/// measured in those where it is largest. That neighbours meet takes all to be measured in the same ones.
std::vector<FaceRate> RayGeometry::Gatherer::rates_of(const Copies& copies) const {
  constexpr float kWorthIt = 1.1f; // finer by so much
  std::vector<std::vector<float>> wanted;
  for (const Copy& c : copies)
    wanted.push_back(fineness(c));
  std::vector<size_t> order(copies.size());
  std::iota(order.begin(), order.end(), size_t{0});
  auto most = [&](size_t c) { return *std::max_element(wanted[c].begin(), wanted[c].end()); };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return most(a) > most(b); });
  std::vector<float> reached(wanted[0].size());
  std::vector<FaceRate> out, rates;
  for (size_t c : order) {
    bool finer = false;
    for (size_t b = 0; b < reached.size(); ++b)
      finer = finer || wanted[c][b] > kWorthIt * reached[b];
    if (!finer) continue;
    for (size_t b = 0; b < reached.size(); ++b)
      reached[b] = std::max(reached[b], wanted[c][b]);
    rates.clear();
    for_each_request(copies[c].first, copies[c].end, [&](std::span<const Run> request) {
      const size_t first = rates.size(), count = count_of(request);
      for (const Run& r : request)
        for (uint32_t k = 0; k < r.count; ++k)
          rates.push_back(measure_rate(r.primitive(k), camera_, false, count == 1));
      limit_faces(std::span(rates).subspan(first));
    });
    out.resize(rates.size());
    for (size_t k = 0; k < rates.size(); ++k)
      out[k] = finer_of(out[k], rates[k]);
  }
  return out;
}

/// Copies with enough faces to be worth a transformation of each ray that comes to them.
void RayGeometry::Gatherer::gather_copies() {
  constexpr size_t kFewest = 64;
  for (Copies& copies : find_copies()) {
    std::erase_if(copies, [&](const Copy& c) { return is_taken(c); });
    if (copies.size() < 2) continue;
    PartLister lister;
    for (uint32_t k = 0; const FaceRate& rate : rates_of(copies))
      lister.add(k++, rate, false);
    const auto parts = lister.take();
    if (parts->faces < kFewest) continue;
    const auto model = static_cast<uint32_t>(out_.items_.size());
    for (const Copy& c : copies) {
      Box bounds;
      for (size_t i = c.first; i < c.end; ++i) {
        taken_[i] = 1;
        bounds.add(runs_[i].camera_bound());
      }
      Item& item = add(traits_[c.first], parts, bounds);
      item.first_primitive = runs_[c.first].first;
      item.model = model;
      item.placed = true;
      item.to_camera = c.to_camera;
      item.to_object = inverse_or_identity(c.to_camera);
    }
  }
}

/// Calls f(runs) for the runs of each request, which have one state.
template <class F> void RayGeometry::Gatherer::for_each_request(size_t first, size_t end, F&& f) const {
  for (size_t next = first; first < end; first = next) {
    while (next < end && runs_[next].state == runs_[first].state)
      ++next;
    f(runs_.subspan(first, next - first));
  }
}

void RayGeometry::Gatherer::find_singles() {
  for_each_request(0, runs_.size(), [&](std::span<const Run> request) {
    const bool alone = count_of(request) == 1, displaced = is_displaced(request[0]);
    const size_t first = singles_.size();
    for (const Run& r : request) {
      const auto run = static_cast<size_t>(&r - runs_.data());
      if (!seen_[run] || taken_[run]) continue;
      List& list = r.state->solid ? solids_[r.state->solid] : by_traits_[traits_[run]];
      for (uint32_t k = 0; k < r.count; ++k) {
        const Primitive p = r.primitive(k);
        const Box box = p.camera_bound({});
        if (!is_usable(box)) continue;
        list.push_back(static_cast<uint32_t>(singles_.size()));
        singles_.push_back({r.first + k, box});
        rates_.push_back(measure_rate(p, camera_, displaced, alone));
      }
    }
    limit_faces(std::span(rates_).subspan(first));
  });
}

/// Halves a list in space until the parts are small enough.
void RayGeometry::Gatherer::split(const RayTraits& traits, List::iterator begin, List::iterator end) {
  if (begin == end) return;
  size_t faces = 0;
  Box centres;
  auto centre = [&](uint32_t k) { return (singles_[k].bounds.min + singles_[k].bounds.max) * 0.5f; };
  for (auto it = begin; it != end; ++it) {
    faces += rates_[*it].faces();
    centres.add(centre(*it));
  }
  if (faces <= most_faces_ || end - begin == 1) {
    List list(begin, end);
    std::sort(list.begin(), list.end());
    add(traits, list);
    return;
  }
  Vec3 size = centres.max - centres.min;
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](uint32_t a, uint32_t b) {
    float x = centre(a)[axis], y = centre(b)[axis];
    return x != y ? x < y : a < b;
  });
  split(traits, begin, middle);
  split(traits, middle, end);
}

RayGeometry::Item& RayGeometry::Gatherer::add(const RayTraits& traits, const List& list) {
  PartLister lister;
  Box bounds;
  for (uint32_t k : list) {
    const Single& s = singles_[k];
    lister.add(s.primitive, rates_[k], is_displaced(primitives_.run_of(s.primitive)));
    bounds.add(s.bounds);
  }
  return add(traits, lister.take(), bounds);
}

RayGeometry::Item& RayGeometry::Gatherer::add(const RayTraits& traits, std::shared_ptr<const ItemParts> parts,
                                              const Box& bounds) {
  auto item = std::make_unique<Item>();
  item->traits = traits;
  item->model = static_cast<uint32_t>(out_.items_.size());
  item->parts = std::move(parts);
  item->bounds = bounds;
  return *out_.items_.emplace_back(std::move(item));
}

/// A solid is one item. Surfaces that no ray sees bound it, too.
void RayGeometry::Gatherer::add_solid(const std::shared_ptr<const SolidTree>& tree, const List& list) {
  auto solid = std::make_unique<RaySolid>();
  solid->tree = tree;
  solid->bounds.resize(tree->size());
  std::optional<RayTraits> traits;
  bool opaque = true;
  for (uint32_t k : list) {
    const size_t run = primitives_.run_number(singles_[k].primitive);
    const PrimitiveState& state = *runs_[run].state;
    solid->node.push_back(state.solid_primitive);
    solid->bounds[state.solid_primitive].add(singles_[k].bounds);
    const RayTraits own = traits_[run];
    opaque = opaque && own.shadow == RayOpacity::kOpaque;
    if (!out_.is_seen_at_all(state.attributes->rays)) continue;
    if (!traits) traits = own;
    traits->specular = traits->specular || own.specular;
    traits->diffuse = traits->diffuse || own.diffuse;
    traits->moving = traits->moving || own.moving;
    traits->shadow = std::max(traits->shadow, own.shadow);
  }
  if (!traits) return;
  if (!opaque && traits->shadow == RayOpacity::kOpaque) traits->shadow = RayOpacity::kShader;
  add(*traits, list).solid = std::move(solid);
}

RayGeometry::RayGeometry(const Scene& scene, const Camera& camera, Displacer* displacer,
                         RayGeometrySettings settings)
    : scene_(scene), displacer_(displacer), settings_(settings), device_(settings.alone) {
  Gatherer(*this, camera).run();
  std::vector<WorldItem> world;
  for (const auto& item : items_) {
    WorldItem w;
    w.bounds = item->bounds;
    // The faces bulge out of a surface's bound by rounding only.
    Vec3 size = w.bounds.max - w.bounds.min;
    w.bounds.grow(1e-5f *
                  std::max({size.x, size.y, size.z, glm::length(w.bounds.min), glm::length(w.bounds.max)}));
    w.one_sided = item->traits.one_sided;
    w.solid = item->solid != nullptr;
    w.placed = item->placed;
    w.to_item = item->to_object;
    // Normals turn round where the space of the faces is a mirror image.
    w.flipped = item->traits.flipped != (item->placed && slvm::determinant3(item->to_object) < 0);
    world.push_back(w);
    solid_.push_back(item->traits.shadow == RayOpacity::kOpaque);
  }
  solid_.push_back(0); // never without data
  ItemFaces& source = *this;
  world_ = std::make_unique<RayWorld>(device_, std::move(world), source);
}

} // namespace render
