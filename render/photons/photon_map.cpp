#include "render/photons/photon_map.h"

#include "render/caches/in_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace render {

namespace {

constexpr const char* kKind = "photon map";
/// Normals with less than this between them, as a cosine, are of other sides or surfaces.
constexpr float kLeastFacing = 0.5f;

bool is_of_side(const Photon& photon, Vec3 N) {
  return N == Vec3(0.0f) || glm::dot(photon.N, N) > kLeastFacing;
}

} // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons) {
  std::vector<subsurface::Vec3> places;
  places.reserve(photons.size());
  for (const Photon& p : photons)
    places.push_back(in_tree(p.P));
  tree_ = subsurface::PointOctree(places);
  photons_.reserve(photons.size());
  for (uint32_t i : tree_.order())
    photons_.push_back(photons[i]);
}

Color PhotonMap::irradiance(const Place& place) const {
  std::vector<subsurface::PointOctree::Near> near;
  tree_.nearest(in_tree(place.P), place.photons + 1, near);
  if (near.empty()) return Color(0);
  // With all photons of the map in it there is none to measure the circle by.
  const bool all = near.size() <= place.photons;
  float most = near.back().distance2;
  size_t count = near.size() - (all ? 0 : 1);
  if (place.max_distance < kInfinity && (all || most > place.max_distance * place.max_distance)) {
    most = place.max_distance * place.max_distance;
    while (count > 0 && near[count - 1].distance2 > most)
      --count;
  }
  if (!(most > 0)) return Color(0);
  Color sum(0);
  for (size_t i = 0; i < count; ++i) {
    const Photon& photon = photons_[near[i].place];
    if (photon.depth >= place.min_depth && is_of_side(photon, place.N)) sum += photon.power;
  }
  return sum / (kPi * most);
}

Color PhotonMap::radiance(Vec3 P, Vec3 N) const {
  std::vector<subsurface::PointOctree::Near> near;
  // Mostly the first one; behind thin walls those of the other side are as near. On surfaces that have none,
  // as mirrors, there is nothing to be found.
  for (size_t count : {4, 48}) {
    tree_.nearest(in_tree(P), count, near);
    for (const auto& n : near)
      if (is_of_side(photons_[n.place], N)) return photons_[n.place].radiance;
    if (near.size() < count) break;
  }
  return Color(0);
}

void PhotonMap::compute_radiance(std::span<const Color> colour, std::span<const int> estimator) {
  tbb::parallel_for(size_t{0}, photons_.size(), [&](size_t i) {
    Photon& p = photons_[i];
    p.radiance = colour[i] * irradiance({p.P, p.N, static_cast<size_t>(estimator[i]), kInfinity, 0});
  });
}

PointTable table_of(std::span<const Photon> photons) {
  PointTable table;
  table.kind = kKind;
  table.points = photons.size();
  auto add = [&](const char* name, Vec3 Photon::*member) {
    std::vector<float>& values = table.add(name, 3);
    for (size_t i = 0; i < photons.size(); ++i)
      for (int c = 0; c < 3; ++c)
        values[3 * i + static_cast<size_t>(c)] = (photons[i].*member)[c];
  };
  add("P", &Photon::P);
  add("N", &Photon::N);
  add("direction", &Photon::direction);
  add("power", &Photon::power);
  add("radiance", &Photon::radiance);
  std::vector<float>& depth = table.add("depth", 1);
  for (size_t i = 0; i < photons.size(); ++i)
    depth[i] = photons[i].depth;
  return table;
}

slvm::Result<std::vector<Photon>> photons_of(const PointTable& table, const std::string& name) {
  if (table.kind != kKind)
    return slvm::Error{fmt::format("{}: this is an {}, not a {}", name, table.kind, kKind)};
  const PointColumn *P = table.find("P", 3), *N = table.find("N", 3), *direction = table.find("direction", 3),
                    *power = table.find("power", 3), *radiance = table.find("radiance", 3),
                    *depth = table.find("depth", 1);
  if (!P || !N || !direction || !power || !radiance || !depth)
    return slvm::Error{
        fmt::format("{}: the {} needs columns P, N, direction, power, radiance and depth", name, kKind)};
  std::vector<Photon> out(table.points);
  auto triple = [](const PointColumn& c, size_t i) {
    return Vec3(c.values[3 * i], c.values[3 * i + 1], c.values[3 * i + 2]);
  };
  for (size_t i = 0; i < out.size(); ++i) {
    out[i] = {triple(*P, i),     triple(*N, i),        triple(*direction, i),
              triple(*power, i), triple(*radiance, i), depth->values[i]};
    if (std::abs(glm::length(out[i].N) - 1) > 1e-3f || !(out[i].depth >= 0))
      return slvm::Error{fmt::format("{}: photon {} cannot be", name, i)};
  }
  return out;
}

} // namespace render
