#include "render/photons/photon_maps.h"

#include <filesystem>
#include <fmt/format.h>

namespace render {

slvm::Result<std::vector<Photon>> PhotonMaps::read(const std::string& name) const {
  const std::string path = find_ ? find_(name) : name;
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return slvm::Error{
        fmt::format("there is no photon map '{}': a frame with Hider \"photon\" must write it first", name)};
  auto table = read_point_table(path);
  if (!table) return slvm::Error{table.error()};
  return photons_of(*table, path);
}

PhotonMaps::Reading& PhotonMaps::reading(std::string_view name) {
  Reading* out = nullptr;
  {
    std::lock_guard lock(mutex_);
    auto it = sources_.find(name);
    if (it == sources_.end()) it = sources_.try_emplace(std::string(name)).first;
    out = &it->second;
  }
  std::call_once(out->once, [&] {
    if (auto photons = read(std::string(name)))
      out->source.map = std::make_unique<const PhotonMap>(std::move(*photons));
    else
      out->source.problem = photons.error();
  });
  return *out;
}

const PhotonMaps::Source& PhotonMaps::source(std::string_view name) {
  return reading(name).source;
}

const PhotonMap* PhotonMaps::at_hits(const std::string& name) {
  if (name.empty()) return nullptr;
  Reading& r = reading(name);
  r.by_hits = true;
  return r.source.map.get();
}

std::vector<std::string> PhotonMaps::problems() const {
  std::lock_guard lock(mutex_);
  std::vector<std::string> out;
  for (const auto& [name, r] : sources_)
    if (r.by_hits && !r.source.problem.empty())
      out.push_back(r.source.problem + "; surface shaders run instead");
  return out;
}

std::string PhotonMaps::photon_map(const slvm::PhotonLookup& lookup) {
  const Source& from = source(lookup.file);
  if (!from.map) return from.problem;
  auto at = [](const std::vector<float>(&planes)[3], size_t i) {
    return planes[0].empty() ? Vec3(0.0f) : Vec3(planes[0][i], planes[1][i], planes[2][i]);
  };
  for (size_t i = 0; i < lookup.points; ++i) {
    if (!lookup.active(i)) continue;
    const Vec3 P = at(lookup.position, i), N = at(lookup.normal, i);
    const Color light =
        lookup.radiance ? from.map->radiance(P, N)
                        : from.map->irradiance({P, N, lookup.photons, lookup.max_distance, lookup.min_depth});
    for (int c = 0; c < 3; ++c)
      lookup.result[c][i] = light[c];
  }
  return "";
}

} // namespace render
