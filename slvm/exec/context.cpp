// ShadingContext: the order of shaders on a grid.
#include "slvm/exec/observer.h"
#include "slvm/exec/plugin_host.h"
#include "slvm/exec/run.h"

#include <algorithm>
#include <cstring>
#include <deque>

namespace slvm {

struct ShadingContext::Impl {
  Impl(const Machine& m, RendererServices& s)
      : state{m, s, cache, LightKernels(m.kernels())}, plugins(m.plugins()) {
    state.plugins = &plugins;
  }

  enum Role { kDisplacement, kSurface, kAtmosphere, kInterior, kExterior, kSingle, kRoles };

  // The run of an instance in a role; kept from grid to grid with its memory, also over grids of a few
  // others: hits of rays go from surface to surface.
  ShaderRun& run_of(Role role, const Instance& instance) {
    std::unique_ptr<ShaderRun>& run = runs[role];
    if (run && ids[role] == instance.id()) return *run;
    if (run) {
      if (idle.size() == kIdleRuns) idle.pop_front();
      idle.emplace_back(ids[role], std::move(run));
    }
    ids[role] = instance.id();
    auto known =
        std::find_if(idle.begin(), idle.end(), [&](const auto& i) { return i.first == instance.id(); });
    if (known == idle.end()) {
      run = std::make_unique<ShaderRun>(state, instance);
    } else {
      run = std::move(known->second);
      idle.erase(known);
    }
    return *run;
  }

  void begin(const ShaderSet& set, Grid& grid) {
    shaders = set;
    state.grid = &grid;
    state.shaders = &shaders;
    cache.clear();
  }

  const ShaderRun*& known(Role role) {
    return role == kDisplacement ? state.displacement
           : role == kAtmosphere ? state.atmosphere
           : role == kInterior   ? state.interior
           : role == kExterior   ? state.exterior
                                 : state.surface;
  }

  /// Parameters of a shader that has not run have their initial values, should `asking` want them.
  void announce(Role role, const Instance* instance, const Instance* asking) {
    if (!instance || !asking || !asking->bound().reads_messages) return;
    ShaderRun& run = run_of(role, *instance);
    run.prepare();
    if (state.observer) state.observer->begin_run(*instance);
    run.compute_defaults();
    if (state.observer) state.observer->end_run(*instance);
    known(role) = &run;
  }
  /// The volumes on both sides of the surface, for incident() and opposite().
  void announce_volumes(const Instance* asking) {
    announce(kInterior, shaders.interior, asking);
    announce(kExterior, shaders.exterior, asking);
  }
  void forget_runs() {
    state.displacement = state.surface = state.atmosphere = state.interior = state.exterior = nullptr;
  }

  const ShaderRun* execute(Role role, const Instance* instance) {
    if (!instance) return nullptr;
    ShaderRun& run = run_of(role, *instance);
    run.prepare();
    if (role != kSingle) known(role) = &run; // lights ask for its parameters while it runs
    run.execute();
    return &run;
  }

  /// An area light by itself shines from the points of its surface that u and v of the grid say, as
  /// LightEmitter::place() takes them. Null for others.
  const Grid* place_on_emitter(const Instance& light, const Grid& grid) {
    if (!light.emitter()) return nullptr;
    if (!on_emitter)
      on_emitter = std::make_unique<Grid>(grid.nu(), grid.nv());
    else
      on_emitter->reset(grid.nu(), grid.nv());
    std::vector<float> places[2];
    for (size_t c = 0; c < 2; ++c) {
      const Planes& at = grid.variable(c == 0 ? Global::ku : Global::kv);
      for (size_t i = 0; i < grid.points(); ++i)
        places[c].push_back(at.data ? at.get(0, i) : 0.5f);
    }
    light.emitter()->place(places[0], places[1], light.program(), *on_emitter);
    return on_emitter.get();
  }

  LightCache cache;
  std::unique_ptr<Grid> on_emitter;
  ShaderSet shaders;
  GridState state;
  PluginThread plugins;
  static constexpr size_t kIdleRuns = 16;
  std::deque<std::pair<uint64_t, std::unique_ptr<ShaderRun>>> idle; ///< by instance, the longest idle first
  std::unique_ptr<ShaderRun> runs[kRoles];
  uint64_t ids[kRoles] = {};
};

ShadingContext::ShadingContext(const Machine& m, RendererServices& s) : impl_(std::make_unique<Impl>(m, s)) {}
ShadingContext::~ShadingContext() = default;

namespace {

// A surface that adds to Ci without setting it first ("Ci += Kr * trace(P, R);") means to start from black,
// and one that sets Oi = 0 and leaves Ci alone means a hole; Oi begins as the surface's opacity.
void begin_surface(Grid& grid) {
  std::fill_n(grid.varying(Global::kCi), 3 * grid.pitch(), 0.0f);
  const Planes from = grid.variable(Global::kOs);
  float* to = grid.varying(Global::kOi);
  for (size_t c = 0; c < 3; ++c) {
    float* plane = to + c * grid.pitch();
    if (from.data && from.step)
      std::memcpy(plane, from.data + c * from.pitch, grid.pitch() * sizeof(float));
    else
      std::fill_n(plane, grid.pitch(), from.data ? from.data[c * from.pitch] : 1.0f);
  }
}

// A light's results are in memory of its run: brings them to the grid, those of several blocks added up.
void light_to_grid(ShaderRun& run, Grid& grid) {
  end_light(run);
  for (Global g : {Global::kL, Global::kCl, Global::kOl}) {
    float* out = grid.varying(g);
    std::fill_n(out, 3 * grid.pitch(), 0.0f);
    for (size_t i = 0; i < run.emission_count; ++i) {
      const Emission& e = run.emissions[i];
      const Planes& from = g == Global::kL ? e.from_light : g == Global::kCl ? e.colour : e.opacity;
      for (size_t c = 0; c < 3; ++c)
        mask_for_each(e.lit.data(), grid.points(), [&](size_t point) {
          float& to = out[c * grid.pitch() + point];
          to = g == Global::kL ? from.get(c, point) : to + from.get(c, point);
        });
    }
  }
}

} // namespace

void ShadingContext::observe(ExecutionObserver* observer) {
  impl_->state.observer = observer;
}

void ShadingContext::displace(const ShaderSet& set, Grid& grid) {
  impl_->begin(set, grid);
  impl_->forget_runs();
  impl_->announce(Impl::kSurface, set.surface, set.displacement);
  impl_->announce(Impl::kAtmosphere, set.atmosphere, set.displacement);
  impl_->announce_volumes(set.displacement);
  impl_->execute(Impl::kDisplacement, set.displacement);
}

void ShadingContext::shade_displaced(const ShaderSet& set, Grid& grid) {
  shade_surface(set, grid);
  shade_atmosphere();
}

void ShadingContext::shade_surface(const ShaderSet& set, Grid& grid) {
  impl_->begin(set, grid);
  if (!set.displacement) impl_->state.displacement = nullptr; // that of another grid
  impl_->state.surface = impl_->state.atmosphere = nullptr;
  impl_->state.interior = impl_->state.exterior = nullptr;
  begin_surface(grid);
  impl_->announce(Impl::kAtmosphere, set.atmosphere, set.surface);
  const bool surface_asks = set.surface && set.surface->bound().reads_messages;
  impl_->announce_volumes(surface_asks ? set.surface : set.atmosphere);
  impl_->execute(Impl::kSurface, set.surface);
}

void ShadingContext::shade_atmosphere() {
  if (impl_->shaders.atmosphere) shade_volume(*impl_->shaders.atmosphere);
  end_grid();
}

void ShadingContext::shade_volume(const Instance& volume) {
  const ShaderSet& set = impl_->shaders;
  impl_->execute(&volume == set.interior   ? Impl::kInterior
                 : &volume == set.exterior ? Impl::kExterior
                                           : Impl::kAtmosphere,
                 &volume);
}

void ShadingContext::end_grid() {
  impl_->plugins.end_grid();
}

void ShadingContext::shade(const ShaderSet& set, Grid& grid) {
  displace(set, grid);
  shade_displaced(set, grid);
}

void ShadingContext::run(const Instance& instance, Grid& grid) {
  impl_->begin({}, grid);
  impl_->forget_runs();
  impl_->run_of(Impl::kSingle, instance).on_emitter = impl_->place_on_emitter(instance, grid);
  impl_->execute(Impl::kSingle, &instance);
  if (instance.shader().kind() == ShaderKind::kLight) light_to_grid(*impl_->runs[Impl::kSingle], grid);
  impl_->plugins.end_grid();
}

const Planes* ShadingContext::output(const Instance& instance, std::string_view name) const {
  for (size_t r = 0; r < Impl::kRoles; ++r)
    if (impl_->runs[r] && impl_->ids[r] == instance.id()) return impl_->runs[r]->parameter(name);
  return nullptr;
}

} // namespace slvm
