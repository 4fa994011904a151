#include "render/caches/cache_files.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace render {

namespace {

Vec3 vector_at(const std::vector<float> (&planes)[3], size_t i) {
  return {planes[0][i], planes[1][i], planes[2][i]};
}

bool is_usable(const IrradianceRecord& r) {
  float sum = r.radius + r.P.x + r.P.y + r.P.z;
  for (float value : r.sample.value)
    sum += value;
  for (size_t c = 0; c < HemisphereSample::kGradients; ++c)
    sum += r.sample.move[c].x + r.sample.move[c].y + r.sample.move[c].z + r.sample.turn[c].x +
           r.sample.turn[c].y + r.sample.turn[c].z;
  return std::isfinite(sum) && std::abs(glm::length(r.N) - 1) < 1e-3f;
}

/// CacheValues by name, those of a mask.
std::string names_of(uint32_t values) {
  std::string out;
  auto add = [&](CacheValue v, const char* name) {
    if (values & v) out += fmt::format("{}{}", out.empty() ? "" : " and ", name);
  };
  add(kOcclusion, "occlusion");
  add(kIrradiance, "irradiance");
  add(kEnvironmentColour, "colours of an environment");
  add(kEnvironmentDirection, "directions of an environment");
  return out;
}

} // namespace

slvm::Result<std::vector<IrradianceRecord>> CacheFiles::read(const std::string& name, bool& missing) const {
  const std::string path = path_of(name);
  std::error_code error;
  missing = !std::filesystem::exists(path, error);
  if (missing)
    return slvm::Error{fmt::format("there is no irradiance cache '{}': a scene must write it first", name)};
  auto table = read_point_table(path);
  if (!table) return slvm::Error{table.error()};
  return records_of(*table, path);
}

const CacheFiles::Source& CacheFiles::source(std::string_view name) {
  Reading* reading = nullptr;
  {
    std::lock_guard lock(mutex_);
    auto it = sources_.find(name);
    if (it == sources_.end()) it = sources_.try_emplace(std::string(name)).first;
    reading = &it->second;
  }
  std::call_once(reading->once, [&] {
    Source& s = reading->source;
    auto records = read(std::string(name), s.missing);
    if (records)
      s.cache = std::make_unique<const IrradianceCache>(std::move(*records));
    else
      s.problem = records.error();
  });
  return reading->source;
}

CacheFiles::Target& CacheFiles::target(std::string_view name) {
  std::lock_guard lock(mutex_);
  auto it = targets_.find(name);
  if (it == targets_.end()) it = targets_.try_emplace(std::string(name)).first;
  return it->second;
}

void CacheFiles::add(std::string_view name, bool keeps, std::vector<IrradianceRecord> records) {
  std::erase_if(records, [](const IrradianceRecord& r) { return !is_usable(r); });
  Target& to = target(name);
  std::lock_guard lock(to.mutex);
  to.keeps = to.keeps || keeps;
  // Grids come in any order, and so which would be left out: then it is none.
  if (to.records.size() + records.size() > kMost) to.full = true;
  if (!to.full) to.records.insert(to.records.end(), records.begin(), records.end());
}

size_t CacheFiles::added() const {
  std::lock_guard lock(mutex_);
  size_t sum = 0;
  for (const auto& [name, target] : targets_)
    sum += target.records.size();
  return sum;
}

std::string CacheFiles::write(const std::string& name, Target& target) {
  if (target.full)
    return fmt::format("the irradiance cache '{}' is not written: it would have more than {} points; a "
                       "larger ShadingRate or Attribute \"irradiance\" \"maxerror\" makes fewer",
                       name, kMost);
  std::vector<IrradianceRecord> records;
  if (target.keeps) {
    bool missing = false;
    if (auto before = read(name, missing))
      records = std::move(*before);
    else if (!missing)
      return fmt::format("the irradiance cache '{}' is not written over what cannot be read: {}", name,
                         before.error());
  }
  const size_t older = records.size();
  records.insert(records.end(), target.records.begin(), target.records.end());
  records = merged(std::move(records), older);
  auto written = write_point_table(name, table_of(records));
  return written ? "" : fmt::format("the irradiance cache is not written: {}", written.error());
}

std::vector<std::string> CacheFiles::write() {
  std::vector<std::string> problems;
  for (auto& [name, target] : targets_)
    if (std::string problem = write(name, target); !problem.empty()) problems.push_back(std::move(problem));
  targets_.clear();
  return problems;
}

std::string CacheFiles::insert(const slvm::IrradianceInsert& in) {
  std::vector<IrradianceRecord> records;
  const uint32_t holds = (in.occlusion.empty() ? 0u : uint32_t{kOcclusion}) |
                         (in.irradiance[0].empty() ? 0u : uint32_t{kIrradiance}) |
                         (in.direction[0].empty() ? 0u : uint32_t{kEnvironmentDirection});
  for (size_t i = 0; i < in.points; ++i) {
    if (!in.active(i)) continue;
    IrradianceRecord& r = records.emplace_back();
    r.P = vector_at(in.position, i);
    r.N = vector_at(in.normal, i);
    r.radius = in.spacing[i];
    r.holds = holds;
    if (holds & kOcclusion) r.sample.value[0] = in.occlusion[i];
    for (size_t c = 0; c < 3; ++c) {
      if (holds & kIrradiance) r.sample.value[1 + c] = in.irradiance[c][i];
      if (holds & kEnvironmentDirection) r.sample.value[7 + c] = in.direction[c][i];
    }
  }
  add(in.file, in.keeps, std::move(records));
  return "";
}

std::string CacheFiles::query(const slvm::IrradianceQuery& q) {
  const Source& from = source(q.file);
  if (!from.cache) return from.problem;
  uint32_t wanted = (q.occlusion ? uint32_t{kOcclusion} : 0u) |
                    (q.irradiance[0] ? uint32_t{kIrradiance} : 0u) |
                    (q.direction[0] ? uint32_t{kEnvironmentDirection} : 0u);
  const uint32_t lacks = from.cache->size() ? wanted & ~from.cache->holds() : 0u;
  wanted &= ~lacks;
  for (size_t i = 0; i < q.points; ++i) {
    if (!q.active(i)) continue;
    const auto found =
        from.cache->find({vector_at(q.position, i), vector_at(q.normal, i), wanted, q.max_error});
    if (!found) continue;
    if (q.found) q.found[i] = 1;
    if (q.occlusion) q.occlusion[i] = found->value[0];
    for (size_t c = 0; c < 3; ++c) {
      if (q.irradiance[c]) q.irradiance[c][i] = found->value[1 + c];
      if (q.direction[c]) q.direction[c][i] = found->value[7 + c];
    }
  }
  return lacks ? fmt::format("the irradiance cache '{}' holds no {}", q.file, names_of(lacks)) : "";
}

} // namespace render
