#include "render/photons/photon_tracer.h"

#include "render/hider/random.h"
#include "render/rays/hemisphere_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <tbb/parallel_for.h>

namespace render {

namespace {

constexpr size_t kAtATime = 4096;
/// However often a photon may be scattered by the attributes of what it meets.
constexpr int kMostScattered = 100;
/// Indices of refraction.
constexpr float kGlass = 1.5f, kWater = 1.333f;

float greatest(Color c) {
  return std::max({c.x, c.y, c.z, 0.0f});
}

Vec3 mirrored(Vec3 d, Vec3 n) {
  return d - 2 * glm::dot(d, n) * n;
}

/// By the cosine to n.
Vec3 diffuse_direction(Vec3 n, float a, float b) {
  Vec3 x, y;
  basis_about(n, x, y);
  const float r = std::sqrt(a), angle = 2 * kPi * b;
  return glm::normalize(r * std::cos(angle) * x + r * std::sin(angle) * y +
                        std::sqrt(std::max(0.0f, 1 - a)) * n);
}

/// Of unpolarised light on a smooth surface, for a ray from a medium into one `eta` times as dense; and the
/// direction behind it. 1 where all is reflected (Fresnel; Snell).
float reflected_part(Vec3 d, Vec3 n, float eta, Vec3& through) {
  const float cosine = -glm::dot(d, n), sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  const float inside = std::sqrt(1 - sine2);
  through = glm::normalize(d / eta + (cosine / eta - inside) * n);
  const float s = (cosine - eta * inside) / (cosine + eta * inside),
              p = (eta * cosine - inside) / (eta * cosine + inside);
  return 0.5f * (s * s + p * p);
}

} // namespace

std::string format_text(const PhotonReport& r) {
  auto colour = [](Color c) { return fmt::format("{:.4g} {:.4g} {:.4g}", c.x, c.y, c.z); };
  return fmt::format("photons: {} emitted, {} stored; power {}: absorbed {}, escaped {}\n", r.emitted,
                     r.stored, colour(r.power), colour(r.absorbed), colour(r.escaped));
}

/// A photon between two surfaces.
struct PhotonTracer::Flying {
  Vec3 origin, direction;
  Color power;
  float bias = -1;
  int specular = 0, diffuse = 0; ///< how often it was scattered
  uint64_t number = 0;
};

/// What a batch of photons meets.
struct PhotonTracer::Hits {
  static constexpr size_t kVectors = 3, kNumbers = 4, kTexts = 3;
  explicit Hits(size_t n) : pitch(n), distance(n) {
    for (auto* planes : {&P, &N, &Cs})
      planes->resize(3 * n);
    for (std::vector<float>* plane :
         {&bias, &specular, &diffuse, &estimator, &ior, &model, &global, &caustic})
      plane->resize(n);
  }
  std::vector<slvm::RayOutput> outputs() {
    using From = slvm::RayOutput::From;
    std::vector<slvm::RayOutput> out;
    auto add = [&](From from, std::string_view name, slvm::Type type, std::vector<float>& to) {
      slvm::RayOutput& o = out.emplace_back();
      o.from = from;
      o.name = name;
      o.type = type;
      o.data = to.data();
      o.pitch = pitch;
    };
    add(From::kPrimitive, "P", slvm::Type::kPoint, P);
    add(From::kPrimitive, "N", slvm::Type::kNormal, N);
    add(From::kPrimitive, "Cs", slvm::Type::kColor, Cs);
    add(From::kAttribute, "trace:bias", slvm::Type::kFloat, bias);
    add(From::kAttribute, "trace:maxspeculardepth", slvm::Type::kFloat, specular);
    add(From::kAttribute, "trace:maxdiffusedepth", slvm::Type::kFloat, diffuse);
    add(From::kAttribute, "photon:estimator", slvm::Type::kFloat, estimator);
    add(From::kAttribute, "photon:ior", slvm::Type::kFloat, ior);
    add(From::kAttribute, "photon:shadingmodel", slvm::Type::kString, model);
    add(From::kAttribute, "photon:globalmap", slvm::Type::kString, global);
    add(From::kAttribute, "photon:causticmap", slvm::Type::kString, caustic);
    return out;
  }
  Vec3 at(const std::vector<float>& planes, size_t i) const {
    return {planes[i], planes[pitch + i], planes[2 * pitch + i]};
  }
  size_t pitch;
  std::vector<float> distance, P, N, Cs, bias, specular, diffuse, estimator, ior, model, global, caustic;
};

/// Photons that are traced together, and what they leave.
struct PhotonTracer::Batch {
  std::vector<Flying> flying;
  std::map<std::string, Map> maps;
  size_t stored = 0;
  Color power{0.0f}, absorbed{0.0f}, escaped{0.0f};
};

PhotonTracer::PhotonTracer(const Scene& scene, const slvm::Machine& machine, const BoundShaders& shaders,
                           slvm::RendererServices& services, RayTracer& rays)
    : scene_(scene), machine_(machine), shaders_(shaders), services_(services), rays_(rays),
      to_world_(inverse_or_identity(scene.world_to_camera)) {}

/// In the order in which primitives are lit by them.
std::vector<const slvm::Instance*> PhotonTracer::lights() const {
  std::vector<const slvm::Instance*> out;
  std::set<const slvm::Instance*> seen;
  for (const PrimitiveList::Run& run : scene_.primitives.runs())
    for (const slvm::Instance* light : shaders_.find(&run.attributes())->lights)
      if (seen.insert(light).second) out.push_back(light);
  return out;
}

PhotonReport PhotonTracer::run(size_t photons) {
  PhotonReport report;
  Box box;
  for (const PrimitiveList::Run& run : scene_.primitives.runs())
    if (run.attributes().rays.photon) box.add(run.camera_bound());
  if (box.empty()) return report;
  const SceneSphere sphere{0.5f * (box.min + box.max),
                           std::max(0.51f * glm::length(box.max - box.min), 1e-6f)};
  std::vector<LightEmission> emissions;
  double all = 0;
  const std::vector<const slvm::Instance*> instances = lights();
  for (const slvm::Instance* light : instances) {
    LightEmission& e = emissions.emplace_back(machine_, services_, *light, sphere);
    if (!e.problem().empty())
      report.problems.push_back(fmt::format("light {}: {}", light->program().name, e.problem()));
    all += static_cast<double>(greatest(e.power()));
  }
  if (!(all > 0)) {
    report.problems.emplace_back("no light sends photons into the scene: no photon map is made");
    return report;
  }
  struct Share {
    size_t light, first, count, of;
  };
  std::vector<Share> shares;
  for (size_t k = 0; k < emissions.size(); ++k) {
    const auto count = static_cast<size_t>(std::llround(
        static_cast<double>(photons) * static_cast<double>(greatest(emissions[k].power())) / all));
    report.emitted += count;
    for (size_t first = 0; first < count; first += kAtATime)
      shares.push_back({k, first, std::min(kAtATime, count - first), count});
  }
  std::vector<Batch> batches(shares.size());
  tbb::parallel_for(size_t{0}, shares.size(), [&](size_t b) {
    const Share& share = shares[b];
    const EmittedPhotons out = emissions[share.light].emit(share.first, share.count, share.of, share.light);
    Batch& batch = batches[b];
    for (size_t i = 0; i < out.power.size(); ++i) {
      batch.power += out.power[i];
      if (greatest(out.power[i]) > 0)
        batch.flying.push_back({out.origin[i], out.direction[i], out.power[i], -1, 0, 0,
                                hash_of(static_cast<int64_t>(share.first + i),
                                        static_cast<int64_t>(share.light), kPhotonScattering)});
    }
    slvm::Grid grid(1, 1);
    const slvm::ShaderSet none;
    trace(batch, {grid, none, *instances[share.light]});
  });
  for (Batch& batch : batches) {
    report.stored += batch.stored;
    report.power += batch.power;
    report.absorbed += batch.absorbed;
    report.escaped += batch.escaped;
    for (auto& [name, map] : batch.maps) {
      Map& to = maps_[name];
      to.photons.insert(to.photons.end(), map.photons.begin(), map.photons.end());
      to.colour.insert(to.colour.end(), map.colour.begin(), map.colour.end());
      to.estimator.insert(to.estimator.end(), map.estimator.begin(), map.estimator.end());
    }
  }
  return report;
}

void PhotonTracer::trace(Batch& batch, const slvm::ShadingState& state) const {
  slvm::RayOptions options;
  options.shades = false;
  while (!batch.flying.empty()) {
    const size_t n = batch.flying.size();
    std::vector<float> planes[6], bias(n);
    for (auto& plane : planes)
      plane.resize(n);
    std::vector<uint32_t> point(n), sample(n);
    for (size_t i = 0; i < n; ++i) {
      const Flying& f = batch.flying[i];
      for (size_t c = 0; c < 3; ++c) {
        planes[c][i] = f.origin[static_cast<int>(c)];
        planes[3 + c][i] = f.direction[static_cast<int>(c)];
      }
      bias[i] = f.bias;
      sample[i] = static_cast<uint32_t>(f.number);
    }
    slvm::RayBatch rays;
    rays.count = n;
    for (size_t c = 0; c < 3; ++c) {
      rays.origin[c] = planes[c].data();
      rays.direction[c] = planes[3 + c].data();
    }
    rays.bias = bias.data();
    rays.point = point.data();
    rays.sample = sample.data();
    Hits hits(n);
    const std::vector<slvm::RayOutput> outputs = hits.outputs();
    rays_.trace(state, options, rays, outputs, hits.distance.data(), nullptr);
    std::vector<Flying> on;
    for (size_t i = 0; i < n; ++i) {
      Flying& f = batch.flying[i];
      if (!(hits.distance[i] < kInfinity) || hits.distance[i] < 0)
        batch.escaped += f.power;
      else if (scatter(f, hits, i, batch))
        on.push_back(f);
    }
    batch.flying = std::move(on);
  }
}

/// At the surface that a photon met. False: it ends there.
bool PhotonTracer::scatter(Flying& f, const Hits& hits, size_t i, Batch& batch) const {
  const Vec3 P = hits.at(hits.P, i), outward = glm::normalize(hits.at(hits.N, i));
  const bool inside = glm::dot(outward, f.direction) > 0;
  const Vec3 n = inside ? -outward : outward; // where it came from
  const Color colour = glm::max(hits.at(hits.Cs, i), Color(0));
  auto text = [&](const std::vector<float>& plane) {
    return std::string(machine_.strings().text(std::bit_cast<uint32_t>(plane[i])));
  };
  const std::string model = text(hits.model);
  const bool matte = model == "matte", translucent = model == "translucent", diffuse = matte || translucent;
  if (diffuse && greatest(colour) > 0)
    for (bool caustic : {false, true}) {
      const std::string name = text(caustic ? hits.caustic : hits.global);
      // Caustics are what only mirrors and lenses sent.
      if (name.empty() || (caustic && (f.specular == 0 || f.diffuse > 0))) continue;
      Map& map = batch.maps[name];
      map.photons.push_back({transform_point(to_world_, P),
                             glm::normalize(Vec3(transform_vector(to_world_, n))),
                             glm::normalize(Vec3(transform_vector(to_world_, f.direction))), f.power,
                             Color(0), static_cast<float>(f.specular + f.diffuse)});
      map.colour.push_back(colour);
      map.estimator.push_back(static_cast<int>(hits.estimator[i]));
      ++batch.stored;
    }
  const int scattered = f.specular + f.diffuse;
  auto random = [&](int64_t what) {
    return hash_of(static_cast<int64_t>(f.number), 16 * scattered + what, kPhotonScattering);
  };
  // Whether it goes on, and with what.
  const Color left = f.power * colour;
  const float chance = std::min(1.0f, greatest(left) / greatest(f.power));
  const bool too_often =
      scattered >= kMostScattered || (diffuse ? static_cast<float>(f.diffuse) >= hits.diffuse[i]
                                              : static_cast<float>(f.specular) >= hits.specular[i]);
  if (too_often || !(upper_unit(random(0)) < chance)) {
    batch.absorbed += f.power;
    return false;
  }
  batch.absorbed += f.power - left / chance;
  f.power = left / chance;
  f.origin = P;
  f.bias = hits.bias[i];
  if (diffuse) {
    ++f.diffuse;
    const uint64_t where = random(1);
    const bool behind = translucent && upper_unit(random(2)) < 0.5f;
    f.direction = diffuse_direction(behind ? -n : n, upper_unit(where), lower_unit(where));
    return true;
  }
  ++f.specular;
  if (model == "chrome") {
    f.direction = mirrored(f.direction, n);
  } else if (model != "transparent") {
    const float dense = hits.ior[i] > 0 ? hits.ior[i] : model == "water" ? kWater : kGlass;
    Vec3 through = f.direction;
    const float part = reflected_part(f.direction, n, inside ? 1 / dense : dense, through);
    f.direction = upper_unit(random(3)) < part ? mirrored(f.direction, n) : through;
  }
  return true;
}

std::vector<std::string> PhotonTracer::write() {
  std::vector<std::string> problems;
  for (auto& [name, map] : maps_) {
    PhotonMap photons(map.photons);
    std::vector<Color> colour;
    std::vector<int> estimator;
    for (uint32_t i : photons.order()) {
      colour.push_back(map.colour[i]);
      estimator.push_back(map.estimator[i]);
    }
    photons.compute_radiance(colour, estimator);
    if (auto written = write_point_table(name, table_of(photons.photons())); !written)
      problems.push_back(fmt::format("the photon map is not written: {}", written.error()));
  }
  return problems;
}

} // namespace render
