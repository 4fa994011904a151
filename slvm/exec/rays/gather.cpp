// Loops over rays: which rays there are, and going through them.
#include "slvm/exec/rays/gather.h"

#include "slvm/exec/rays/shooting.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace slvm {
namespace {

constexpr std::string_view kMapCategory = "environment:";

/// Numbers that results of a batch may take at once.
constexpr size_t kMostResults = 1 << 24;

size_t planes_of(const RayOutput& output) {
  return static_cast<size_t>(components(output.type)) * std::max(output.elements, 1u);
}

bool hits_something(float distance) {
  return distance >= 0 && distance < std::numeric_limits<float>::infinity();
}

} // namespace

// ---- What the call says.

void GatherLoop::begin(const GridCall& call, Form form) {
  form_ = form;
  code_ = call.code;
  const CallTokens tokens(call, form == Form::kGather ? 5 : 3);
  read_category(text_of(call.run, call.operands[0].planes));
  RaySpec spec;
  spec.origin = call.operands[1].planes;
  spec.direction = call.operands[2].planes;
  if (form == Form::kGather) read_spec(call, tokens, spec);
  spec.bias = tokens.values("bias", -1);
  spec.max_distance = tokens.values("maxdist", std::numeric_limits<float>::infinity());
  spec.sample_base = tokens.values("samplebase", default_sample_base(call.run, spec.samples));
  spec.weight = tokens.weight();
  const bool shades = options_.shades;
  options_ = tokens.ray_options(kind_for_cone(call.run, spec.angle));
  options_.shades = shades;
  read_values(call, tokens);
  options_.wants_distance = std::any_of(values_.begin(), values_.end(),
                                        [](const RayValue& v) { return v.of == RayValue::Of::kLength; });
  spec.differentials = options_.shades && std::any_of(values_.begin(), values_.end(), [](const RayValue& v) {
                         return v.of == RayValue::Of::kHit && v.output.from != RayOutput::From::kPrimitive &&
                                v.output.from != RayOutput::From::kAttribute;
                       });
  source_.begin(call, spec, options_.seed);
}

void GatherLoop::read_category(std::string_view category) {
  mode_ = Mode::kRays;
  from_map_ = false;
  options_.shades = category != "occlusion";
  if (form_ == Form::kTraverse) return;
  if (category == "samplepattern") mode_ = Mode::kPattern;
  if (!category.starts_with(kMapCategory)) return;
  mode_ = Mode::kMapSamples;
  from_map_ = true;
  map_ = category.substr(kMapCategory.size());
}

void GatherLoop::read_spec(const GridCall& call, const CallTokens& tokens, RaySpec& spec) {
  spec.direction_counts = mode_ != Mode::kMapSamples;
  spec.angle = PointValue(call.operands[3].planes);
  spec.samples = PointValue(call.operands[4].planes);
  spec.may_be_none = true;
  if (const float count = tokens.number("samplecount", 0); count > 0) spec.samples = count;
  const std::string_view distribution = tokens.text("distribution");
  spec.cosine = distribution == "cosine";
  if (distribution.empty() || distribution == "uniform" || spec.cosine || mode_ != Mode::kRays) return;
  from_map_ = true;
  map_ = distribution;
}

void GatherLoop::read_values(const GridCall& call, const CallTokens& tokens) {
  using Of = RayValue::Of;
  using From = RayOutput::From;
  static constexpr std::pair<std::string_view, Of> kOwn[] = {{"ray:origin", Of::kOrigin},
                                                             {"ray:direction", Of::kDirection},
                                                             {"ray:length", Of::kLength},
                                                             {"effectivebias", Of::kBias},
                                                             {"sample:randompair", Of::kRandomPair},
                                                             {"environment:color", Of::kMapColour},
                                                             {"environment:direction", Of::kMapDirection},
                                                             {"environment:solidangle", Of::kMapSolidAngle}};
  static constexpr std::pair<std::string_view, From> kAtHits[] = {
      {"surface:", From::kSurface},     {"displacement:", From::kDisplacement},
      {"volume:", From::kVolume},       {"atmosphere:", From::kAtmosphere},
      {"interior:", From::kInterior},   {"exterior:", From::kExterior},
      {"primitive:", From::kPrimitive}, {"attribute:", From::kAttribute}};
  values_.clear();
  tokens.for_each([&](std::string_view name, const GridOperand& o) {
    RayValue v;
    v.token = call.run.state.machine.strings().intern(name);
    v.output.type = o.type;
    v.output.elements = o.array ? o.planes.elements : 0;
    for (auto [own, of] : kOwn)
      if (name == own) {
        v.of = of;
        values_.push_back(std::move(v));
        return;
      }
    for (auto [prefix, from] : kAtHits)
      if (name.starts_with(prefix)) {
        v.output.from = from;
        if (planes_of(v.output) * call.run.points > kMostResults) {
          call.run.report(call.code, MessageSeverity::kError,
                          fmt::format("\"{}\": arrays of {} elements are too much for {} rays", name,
                                      v.output.elements, call.run.points),
                          call.run.points);
          return;
        }
        // The machine keeps its strings.
        v.output.name = call.run.state.machine.strings().text(v.token).substr(prefix.size());
        values_.push_back(std::move(v));
        return;
      }
  });
  auto wants_bias = [](const RayValue& v) { return v.of == Of::kBias; };
  if (std::any_of(values_.begin(), values_.end(), wants_bias)) attribute_bias_ = bias_attribute(call.run);
}

// ---- Rounds.

void GatherLoop::start(bool lanes_leave) {
  lanes_leave_ = lanes_leave;
  round_ = traced_to_ = 0;
  rays_.clear();
  first_ = last_ = 0;
  if (form_ == Form::kTraverse) {
    cursors_.assign(source_.size(), {});
    ended_.assign(source_.size(), 0);
  }
}

bool GatherLoop::next(ShaderRun& run, const MaskWord* in_loop) {
  lanes_.resize(mask_words(run.pitch));
  hits_.resize(mask_words(run.pitch));
  return form_ == Form::kGather ? next_sample(run, in_loop) : next_surface(run, in_loop);
}

std::vector<uint32_t> GatherLoop::places_in(const MaskWord* in_loop) const {
  std::vector<uint32_t> places;
  for (uint32_t i = 0; i < source_.size(); ++i)
    if (mask_test(in_loop, source_.point[i])) places.push_back(i);
  return places;
}

bool GatherLoop::next_sample(ShaderRun& run, const MaskWord* in_loop) {
  if (mask_none(in_loop, run.points)) return false;
  while (round_ < source_.most_samples()) {
    if (round_ == traced_to_) make_samples(run, in_loop);
    first_ = last_;
    const RayBatch batch = rays_.batch();
    while (last_ < rays_.size() && batch.sample[last_] == round_)
      ++last_;
    // Points that shoot nothing have rays that miss, unless it is the map that leaves rays out.
    enter_round(run, first_, last_, !from_map_);
    ++round_;
    MaskWord some = 0;
    for (size_t i = 0; i < lanes_.size(); ++i)
      some |= lanes_[i] & in_loop[i];
    if (some) return true;
  }
  return false;
}

// The lanes of rays [first, last), and those without a ray where these count as misses.
void GatherLoop::enter_round(const ShaderRun& run, size_t first, size_t last, bool unshot_miss) {
  mask_clear(lanes_.data(), run.pitch);
  mask_clear(hits_.data(), run.pitch);
  auto bit = [](uint32_t point) { return MaskWord{1} << (point % kMaskWordLanes); };
  if (unshot_miss)
    for (size_t i = 0; i < source_.size(); ++i)
      if (!source_.shoots[i] && source_.samples[i] > round_)
        lanes_[source_.point[i] / kMaskWordLanes] |= bit(source_.point[i]);
  for (size_t r = first; r < last; ++r) {
    const uint32_t point = rays_.point(r);
    if (distance_[r] < 0) continue; // not shot: neither block
    lanes_[point / kMaskWordLanes] |= bit(point);
    if (hits_something(distance_[r])) hits_[point / kMaskWordLanes] |= bit(point);
  }
}

void GatherLoop::make_samples(ShaderRun& run, const MaskWord* in_loop) {
  const std::vector<uint32_t> places = places_in(in_loop);
  size_t planes = 1;
  for (const RayValue& v : values_)
    planes += planes_of(v.output);
  const size_t rays = std::min(kRaysAtOnce, kMostResults / planes);
  const size_t rounds = lanes_leave_ ? 1 : std::max<size_t>(rays / std::max<size_t>(places.size(), 1), 1);
  rays_.clear();
  first_ = last_ = 0;
  for (size_t i = 0; i < rounds && traced_to_ < source_.most_samples(); ++i)
    rays_.add(source_, places, traced_to_++);
  if (from_map_) draw_from_map(run);
  if (mode_ == Mode::kRays)
    trace(run, nullptr);
  else
    distance_.assign(rays_.size(), 0.0f); // through the body
}

// Directions as the map's light comes; those outside the cone, if there is one, are no rays.
void GatherLoop::draw_from_map(ShaderRun& run) {
  density_.assign(rays_.size(), 0.0f);
  EnvironmentSamples samples;
  samples.map = map_;
  samples.count = rays_.size();
  samples.random[0] = rays_.radii();
  samples.random[1] = rays_.turns();
  for (size_t c = 0; c < 3; ++c) {
    colour_[c].assign(rays_.size(), 0.0f);
    samples.direction[c] = rays_.directions(c);
    samples.colour[c] = colour_[c].data();
  }
  samples.density = density_.data();
  RayServices* services = ray_services(run, code_, source_.size());
  if (services) {
    const std::string problem = services->sample_environment(run.shading_state(), samples);
    if (!problem.empty())
      run.report(code_, MessageSeverity::kWarning, fmt::format("environment \"{}\": {}", map_, problem),
                 source_.size());
  }
  auto keep = [&](size_t r) {
    if (!(density_[r] > 0)) return false;
    if (mode_ == Mode::kMapSamples || source_.cosine_of_angle.empty()) return true;
    const uint32_t i = rays_.place(r);
    float cosine = 0;
    for (size_t c = 0; c < 3; ++c)
      cosine += rays_.direction(c, r) * source_.axis[c][i];
    return cosine >= source_.cosine_of_angle[i] - 1e-6f;
  };
  size_t kept = 0;
  std::vector<uint8_t> keeps(rays_.size());
  for (size_t r = 0; r < rays_.size(); ++r) {
    keeps[r] = keep(r);
    if (!keeps[r]) continue;
    density_[kept] = density_[r];
    for (PointArray& component : colour_)
      component[kept] = component[r];
    ++kept;
  }
  rays_.filter([&](size_t r) { return keeps[r] != 0; });
}

void GatherLoop::trace(ShaderRun& run, RayCursor* cursors) {
  const size_t count = rays_.size();
  distance_.assign(count, std::numeric_limits<float>::infinity());
  std::vector<RayOutput> outputs;
  for (RayValue& v : values_) {
    if (v.of != RayValue::Of::kHit) continue;
    const size_t planes = planes_of(v.output);
    v.data.resize(planes * count);
    v.found.assign(count, 0);
    v.output.data = v.data.data();
    v.output.pitch = count;
    v.output.found = v.found.data();
    outputs.push_back(v.output);
  }
  RayServices* services = ray_services(run, code_, source_.size());
  if (services && count)
    services->trace(run.shading_state(), options_, rays_.batch(), outputs, distance_.data(), cursors);
  for (const RayOutput& o : outputs) // whatever is said of rays that hit nothing
    for (size_t r = 0; r < count; ++r)
      o.found[r] &= static_cast<uint8_t>(hits_something(distance_[r]));
}

// One surface of each ray. Points whose first look finds nothing take the else block; others end without.
bool GatherLoop::next_surface(ShaderRun& run, const MaskWord* in_loop) {
  std::vector<uint32_t> places = places_in(in_loop);
  std::erase_if(places, [&](uint32_t i) { return ended_[i] != 0; });
  if (places.empty()) return false;
  rays_.clear();
  rays_.add(source_, places, 0);
  std::vector<RayCursor> cursors(rays_.size());
  for (size_t r = 0; r < cursors.size(); ++r)
    cursors[r] = cursors_[rays_.place(r)];
  trace(run, cursors.data());
  first_ = 0;
  last_ = rays_.size();
  const bool first_look = round_ == 0;
  enter_round(run, first_, last_, first_look);
  for (uint32_t i : places)
    ended_[i] = 1;
  for (size_t r = 0; r < last_; ++r) {
    cursors_[rays_.place(r)] = cursors[r];
    if (hits_something(distance_[r])) ended_[rays_.place(r)] = 0;
  }
  if (first_look)
    ++round_;
  else
    lanes_ = hits_;
  return mask_any(lanes_.data(), run.points);
}

// ---- Loops in loops.

GatherStack::GatherStack() = default;
GatherStack::~GatherStack() = default;

GatherLoop& GatherStack::announce() {
  if (open_ == loops_.size()) loops_.push_back(std::make_unique<GatherLoop>());
  announced_ = true;
  return *loops_[open_];
}

bool GatherStack::open(bool lanes_leave) {
  if (!announced_) return false;
  announced_ = false;
  loops_[open_++]->start(lanes_leave);
  return true;
}

bool GatherStack::any_scattered() const {
  for (size_t i = 0; i < open_; ++i)
    if (loops_[i]->scattered()) return true;
  return false;
}

} // namespace slvm
