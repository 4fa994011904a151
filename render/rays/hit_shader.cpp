// Shading of hits.
#include "render/rays/hit_shader.h"

#include "render/hider/random.h"
#include "render/photons/photon_maps.h"
#include "render/shading/default_surface.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

namespace render {

namespace {

using slvm::Global;
using From = slvm::RayOutput::From;

/// Hits shaded at a time, about.
constexpr size_t kHitsAGrid = 256;

bool is_from(std::span<const slvm::RayOutput> outputs, std::initializer_list<From> wanted) {
  return std::any_of(outputs.begin(), outputs.end(), [&](const slvm::RayOutput& o) {
    return std::find(wanted.begin(), wanted.end(), o.from) != wanted.end();
  });
}

/// Whether results of a shader can depend on neighbouring points, with the values its parameters have.
bool differentiates(const slvm::Instance& instance) {
  const slvm::Program& p = instance.program();
  return std::any_of(p.imports.begin(), p.imports.end(), [&](slvm::ShadeopId id) {
    const slvm::ShadeopInfo& info = p.plugins.info(id);
    if (!(info.flags & slvm::kDerivative)) return false;
    // Rays that go on have footprints, too.
    return !(info.flags & slvm::kRays) || info.name == "trace" || info.name == "gather" ||
           info.name == "traverse";
  });
}

/// Whether a shader reads a predefined variable (or else a parameter).
bool reads(const slvm::Instance& instance, std::string_view name, bool parameter) {
  const auto& slots = instance.program().slots;
  return std::any_of(slots.begin(), slots.end(),
                     [&](const slvm::Slot& s) { return s.parameter == parameter && s.name == name; });
}

bool fits(const slvm::RayOutput& out, slvm::Type type, uint32_t elements) {
  bool same = out.type == type || (slvm::is_triple(out.type) && slvm::is_triple(type));
  return same && out.elements == elements;
}

/// Stores values of hits at their rays. `lanes`: only of these hits; empty: of all.
void store(const slvm::RayOutput& out, const slvm::Planes* from, std::span<const HitRay> hits,
           std::span<const uint32_t> lanes) {
  if (!from || !from->data || !fits(out, from->type, from->elements)) return;
  const size_t planes = static_cast<size_t>(slvm::components(out.type)) * (out.elements ? out.elements : 1);
  auto each = [&](auto&& f) {
    if (lanes.empty())
      for (size_t i = 0; i < hits.size(); ++i)
        f(i);
    else
      for (uint32_t i : lanes)
        f(i);
  };
  for (size_t c = 0; c < planes; ++c) {
    const float* values = from->data + c * from->pitch;
    float* to = out.data + c * out.pitch;
    const size_t step = from->step;
    each([&](size_t i) { to[hits[i].slot] = values[i * step]; });
  }
  if (out.found) each([&](size_t i) { out.found[hits[i].slot] = 1; });
}

} // namespace

/// A context and a grid for one call at a time: shaders at hits trace rays whose hits need others.
struct HitShader::Worker {
  Worker(const slvm::Machine& machine, slvm::RendererServices& services) : context(machine, services) {}
  slvm::ShadingContext context;
  HitGrid hits;
  HitVolumes volumes;
  slvm::Grid lattice{2, 2};
  HitOrder order;
};

class HitShader::WorkerLease {
public:
  WorkerLease(HitShader& owner, bool displacer)
      : owner_(owner), idle_(displacer ? owner.idle_displacers_ : owner.idle_) {
    std::lock_guard lock(owner.workers_mutex_);
    if (!idle_.empty()) {
      worker_ = std::move(idle_.back());
      idle_.pop_back();
    } else {
      worker_ = std::make_unique<Worker>(
          owner.machine_, displacer ? static_cast<slvm::RendererServices&>(owner.quiet_) : owner.services_);
    }
  }
  ~WorkerLease() {
    std::lock_guard lock(owner_.workers_mutex_);
    idle_.push_back(std::move(worker_));
  }
  WorkerLease(const WorkerLease&) = delete;
  WorkerLease& operator=(const WorkerLease&) = delete;
  Worker& operator*() const { return *worker_; }

private:
  HitShader& owner_;
  std::vector<std::unique_ptr<Worker>>& idle_;
  std::unique_ptr<Worker> worker_;
};

/// Which shaders have to run for the outputs.
struct HitShader::Demand {
  bool displacement, surface, volumes;
  bool attributes; ///< those of the objects themselves

  Demand(std::span<const slvm::RayOutput> outputs, bool shades) {
    volumes = shades && is_from(outputs, {From::kShaded, From::kVolume, From::kAtmosphere, From::kInterior,
                                          From::kExterior});
    surface = shades && (volumes || is_from(outputs, {From::kSurface}));
    displacement = surface || (shades && is_from(outputs, {From::kDisplacement}));
    attributes = is_from(outputs, {From::kAttribute});
  }
};

/// What is the same for the hits of a batch that can be diced together.
struct HitShader::Work {
  bool moves_points = false; ///< rays see displacements
  slvm::ShaderSet set;       ///< those that run
  std::vector<const slvm::Instance*> volumes;
  bool plain = false;                 ///< no shader runs: the look of the primitive
  const PhotonMap* photons = nullptr; ///< or that of photons
  bool beside = false;                ///< somebody differentiates
  bool done_beside = false;           ///< nobody differentiates what the surface shader leaves behind
  bool apart = false; ///< E is read: hits of rays from different places cannot be shaded together
  std::span<const slvm::RayOutput> outputs;
  ReadVariables read; ///< refers to this

  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  template <class F> bool any_shader(F&& f) const {
    for (const slvm::Instance* shader : {set.displacement, set.surface})
      if (shader && f(*shader)) return true;
    return std::any_of(volumes.begin(), volumes.end(), [&](const slvm::Instance* v) { return f(*v); });
  }
};

HitShader::HitShader(const Scene& scene, const Camera& camera, const slvm::Machine& machine,
                     const BoundShaders& shaders, slvm::RendererServices& services)
    : scene_(scene), machine_(machine), shaders_(shaders), services_(services), quiet_(services),
      groups_(scene, shaders) {
  const Options& o = scene.options;
  dice_ = {&camera, &machine.strings(), o.shutter_open + o.shutter_offset, o.shutter_close - o.shutter_open};
}

HitShader::~HitShader() = default;

const slvm::ShaderSet& HitShader::set_of(const Primitive& p) const {
  return shaders_.find(&p.attributes())->shaders;
}

bool HitShader::displaces(const Primitive& p) const {
  return set_of(p).displacement != nullptr;
}

void HitShader::positions(const Primitive& primitive, const UvRect& rect, int nu, int nv,
                          std::vector<Vec3>& P) {
  WorkerLease lease(*this, true);
  slvm::Grid& grid = (*lease).lattice;
  GridTask task;
  task.rect = rect;
  task.nu = nu;
  task.nv = nv;
  auto bits = [](float x) { return static_cast<int64_t>(std::bit_cast<uint32_t>(x)); };
  dice({&primitive, 1}, task, hash_of(bits(rect.u0), bits(rect.v0), kDisplacedFaces), dice_, {}, grid);
  (*lease).context.displace(set_of(primitive), grid);
  const slvm::Planes& from = grid.variable(Global::kP);
  P.resize(grid.points());
  for (size_t k = 0; k < P.size(); ++k)
    P[k] = {from.get(0, k), from.get(1, k), from.get(2, k)};
}

std::vector<HitRay> HitShader::take_list() {
  std::lock_guard lock(workers_mutex_);
  std::vector<HitRay> list;
  if (!lists_.empty()) {
    list = std::move(lists_.back());
    lists_.pop_back();
  }
  return list;
}

void HitShader::give_back(std::vector<HitRay> list) {
  list.clear();
  std::lock_guard lock(workers_mutex_);
  lists_.push_back(std::move(list));
}

void HitShader::shade(std::span<const HitRay> all, const HitBatch& batch,
                      std::span<const slvm::RayOutput> outputs) {
  if (all.empty() || outputs.empty()) return;
  Demand demand(outputs, batch.shades);
  WorkerLease lease(*this, false);
  Worker& worker = *lease;
  const std::span<const HitRay> hits = worker.order.sort(all, groups_);
  std::optional<Work> work;
  auto next_group = worker.order.group_ends().begin();
  size_t group_end = 0, most = 0;
  auto state = [&](const HitRay& hit) { return &scene_.primitives.state(hit.place.primitive); };
  for (size_t first = 0, end = 0; first < hits.size(); first = end) {
    if (first == group_end) {
      prepare(scene_.primitives[hits[first].place.primitive], batch, outputs, demand, work.emplace());
      group_end = *next_group++;
      // Grids of about the same size, none of a few points.
      const size_t count = group_end - first,
                   grids = std::max<size_t>((count + kHitsAGrid / 2) / kHitsAGrid, 1);
      most = (count + grids - 1) / grids;
    }
    end = std::min(first + most, group_end);
    const HitRay& one = hits[first];
    if (work->apart || demand.attributes)
      for (size_t i = first + 1; i < end; ++i)
        if ((work->apart && batch.rays.origin(hits[i]) != batch.rays.origin(one)) ||
            (demand.attributes && state(hits[i]) != state(one)))
          end = i;
    shade_grid(worker, hits.subspan(first, end - first), batch, outputs, demand, *work,
               hash_of(static_cast<int64_t>(batch.seed), static_cast<int64_t>(first), kHits));
  }
}

/// The predefined variables that shaders, their lights and outputs read.
std::bitset<slvm::kGlobalCount> HitShader::read_of_grids(const Work& work, const BoundAttributes& bound,
                                                         std::span<const slvm::RayOutput> outputs) {
  std::bitset<slvm::kGlobalCount> out = bound.read;
  // Displaced points get new tangents; volumes are chosen by the geometric normal.
  if (work.set.displacement || !work.volumes.empty()) return out.set();
  for (const slvm::RayOutput& o : outputs)
    if (Global g = slvm::find_global(o.name); g != Global::kCount) out.set(static_cast<size_t>(g));
  return out;
}

/// The surface shader as far as the outputs ask for it: shadow rays need no lights for an opacity.
const slvm::Instance* HitShader::narrowed(const slvm::Instance* surface,
                                          std::span<const slvm::RayOutput> outputs) {
  std::vector<std::string> names;
  for (const slvm::RayOutput& out : outputs)
    if (out.from == From::kSurface) names.emplace_back(out.name);
  std::sort(names.begin(), names.end());
  std::pair<uint64_t, std::string> key(surface->id(), {});
  for (const std::string& name : names)
    key.second += name + ' ';
  std::lock_guard lock(narrow_mutex_);
  auto [it, is_new] = narrow_.try_emplace(std::move(key));
  if (is_new) it->second = machine_.narrowed(*surface, names);
  return it->second ? it->second.get() : surface;
}

void HitShader::prepare(const Primitive& primitive, const HitBatch& batch,
                        std::span<const slvm::RayOutput> outputs, const Demand& demand, Work& w) {
  w.moves_points = primitive.attributes().rays.displacements;
  w.outputs = outputs;
  const BoundAttributes& bound = *shaders_.find(&primitive.attributes());
  w.set = bound.shaders;
  if (photon_maps_ && batch.kind == slvm::RayKind::kDiffuse && batch.mode == slvm::HitMode::kDefault &&
      batch.shades)
    w.photons = photon_maps_->at_hits(primitive.attributes().rays.global_map);
  w.plain = w.photons || is_primitive_mode(primitive, batch);
  if (!demand.displacement || w.plain) w.set.displacement = nullptr;
  if (!demand.surface || w.plain) w.set.surface = nullptr;
  if (demand.volumes && !w.plain) w.volumes = possible_volumes(batch.from.shaders, w.set);
  if (w.set.surface && !demand.volumes) w.set.surface = narrowed(w.set.surface, outputs);
  const bool all_of_it = w.set.surface == bound.shaders.surface; // else no light runs
  const bool lights = all_of_it && w.set.surface &&
                      std::any_of(bound.lights.begin(), bound.lights.end(),
                                  [](auto* light) { return differentiates(*light); });
  w.beside = w.any_shader(differentiates) || lights;
  w.done_beside = !lights && std::none_of(w.volumes.begin(), w.volumes.end(),
                                          [](auto* volume) { return differentiates(*volume); });
  w.apart = w.any_shader([](const slvm::Instance& shader) { return reads(shader, "E", false); });
  w.read.predefined = read_of_grids(w, bound, outputs);
  if (w.done_beside && w.set.surface && !w.set.displacement) {
    const slvm::BesideReads& beside = w.set.surface->reads_beside();
    w.read.predefined_beside = beside.predefined;
    w.read.of_primitives_beside = [&beside](const std::string& name) {
      return std::find(beside.parameters.begin(), beside.parameters.end(), name) != beside.parameters.end();
    };
  }
  w.read.of_primitives = [&w](const std::string& name) {
    return w.any_shader([&](const slvm::Instance& s) { return reads(s, name, true); }) ||
           std::any_of(w.outputs.begin(), w.outputs.end(),
                       [&](const slvm::RayOutput& out) { return out.name == name; });
  };
}

bool HitShader::is_primitive_mode(const Primitive& p, const HitBatch& batch) const {
  if (batch.mode != slvm::HitMode::kDefault) return batch.mode == slvm::HitMode::kPrimitive;
  const RayAttributes& a = p.attributes().rays;
  return batch.kind == slvm::RayKind::kSpecular  ? !a.specular_shaded
         : batch.kind == slvm::RayKind::kDiffuse ? !a.diffuse_shaded
                                                 : !a.transmission_shaded;
}

namespace {

/// Ci = Os Cs, Oi = Os: the look of a hit whose shaders do not run.
void look_like_primitive(slvm::Grid& grid) {
  float *Ci = grid.varying(Global::kCi), *Oi = grid.varying(Global::kOi);
  const slvm::Planes &Cs = grid.variable(Global::kCs), &Os = grid.variable(Global::kOs);
  for (size_t c = 0; c < 3; ++c)
    for (size_t k = 0; k < grid.points(); ++k) {
      Oi[c * grid.pitch() + k] = Os.get(c, k);
      Ci[c * grid.pitch() + k] = Os.get(c, k) * Cs.get(c, k);
    }
}

/// Ci is what photons near by leave with, on the side that the ray comes from.
void look_like_photons(slvm::Grid& grid, const PhotonMap& photons, const Matrix4& to_world,
                       const HitRays& rays, std::span<const HitRay> hits) {
  float* Ci = grid.varying(Global::kCi);
  const slvm::Planes &P = grid.variable(Global::kP), &N = grid.variable(Global::kN);
  for (size_t k = 0; k < hits.size(); ++k) {
    Vec3 n(N.get(0, k), N.get(1, k), N.get(2, k));
    if (glm::dot(n, rays.direction(hits[k])) > 0) n = -n;
    const std::array<float, 3> across = slvm::transform_normal(to_world, {n.x, n.y, n.z});
    const Color c = photons.radiance(transform_point(to_world, Vec3(P.get(0, k), P.get(1, k), P.get(2, k))),
                                     glm::normalize(Vec3(across[0], across[1], across[2])));
    for (int i = 0; i < 3; ++i)
      Ci[static_cast<size_t>(i) * grid.pitch() + k] = c[i];
  }
}

/// Takes the outputs of one kind from a grid: parameters of the shader, predefined variables, primitive
/// variables.
void take(const slvm::ShadingContext& context, const slvm::Grid& grid, const slvm::Instance* shader,
          From from, std::span<const HitRay> hits, std::span<const slvm::RayOutput> outputs,
          std::span<const uint32_t> lanes = {}) {
  for (const slvm::RayOutput& out : outputs) {
    if (out.from != from) continue;
    const slvm::Planes* planes = shader ? context.output(*shader, out.name) : nullptr;
    if (!planes)
      if (Global g = slvm::find_global(out.name); g != Global::kCount) planes = &grid.variable(g);
    if (!planes || !planes->data) planes = grid.primvar(std::string(out.name));
    store(out, planes, hits, lanes);
  }
}

} // namespace

void HitShader::take_attributes(const HitBatch& batch, const slvm::Grid& grid, const slvm::ShaderSet& set,
                                std::span<const HitRay> hits, std::span<const slvm::RayOutput> outputs) {
  slvm::ShadingState state{grid, set, batch.from.running};
  for (const slvm::RayOutput& out : outputs) {
    slvm::Value value;
    if (out.from != From::kAttribute || !services_.attribute(state, out.name, value)) continue;
    for (const std::string& s : value.strings)
      value.numbers.push_back(std::bit_cast<float>(machine_.strings().intern(s)));
    size_t planes = static_cast<size_t>(slvm::components(value.type)) * (value.elements ? value.elements : 1);
    if (value.numbers.size() != planes || !fits(out, value.type, value.elements)) continue;
    for (const HitRay& hit : hits) {
      for (size_t c = 0; c < planes; ++c)
        out.data[c * out.pitch + hit.slot] = value.numbers[c];
      if (out.found) out.found[hit.slot] = 1;
    }
  }
}

void HitShader::shade_grid(Worker& worker, std::span<const HitRay> hits, const HitBatch& batch,
                           std::span<const slvm::RayOutput> outputs, const Demand& demand, const Work& work,
                           uint64_t id) {
  const slvm::ShaderSet& set = work.set;
  slvm::Grid& grid = worker.hits.grid;
  worker.hits.dice(scene_, batch.rays, hits, work.beside, dice_, work.read);
  const float* weight[3] = {grid.ray.weight[0], grid.ray.weight[1], grid.ray.weight[2]};
  grid.ray = batch.facts;
  std::copy_n(weight, 3, grid.ray.weight);
  grid.id = id;
  ++grids_;
  points_ += grid.points();
  slvm::ShadingContext& context = worker.context;
  take(context, grid, nullptr, From::kPrimitive, hits, outputs);
  take_attributes(batch, grid, set, hits, outputs);
  if (set.displacement) {
    worker.hits.before_displacement();
    context.displace(set, grid);
    worker.hits.after_displacement(work.moves_points);
    take(context, grid, set.displacement, From::kDisplacement, hits, outputs);
  }
  if (!demand.surface) return;
  grid.neighbours_end = work.done_beside;
  context.shade_surface(set, grid);
  if (work.plain) look_like_primitive(grid);
  if (work.photons)
    look_like_photons(grid, *work.photons, inverse_or_identity(scene_.world_to_camera), batch.rays, hits);
  else if (!work.plain && !set.surface)
    shade_by_default(grid);
  take(context, grid, set.surface, From::kSurface, hits, outputs);
  if (!work.volumes.empty()) {
    worker.volumes.find(batch.from, set, grid, batch.rays, hits);
    worker.volumes.shade(context, grid, [&](const slvm::Instance& v, std::span<const uint32_t> lanes) {
      take(context, grid, &v, From::kVolume, hits, outputs, lanes);
      take(context, grid, &v,
           &v == set.atmosphere                                      ? From::kAtmosphere
           : &v == set.interior || &v == batch.from.shaders.interior ? From::kInterior
                                                                     : From::kExterior,
           hits, outputs, lanes);
    });
  }
  context.end_grid();
  take(context, grid, nullptr, From::kShaded, hits, outputs);
}

} // namespace render
