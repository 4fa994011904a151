#include "stdlib/scattering/baked_clouds.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace subsurface {
namespace {

using slvm::CloudPoints;
using slvm::Type;
using Values = CloudPoints::Channel;

constexpr size_t kNearest = 4; ///< points that count where no radius says so
constexpr float kPi = std::numbers::pi_v<float>;

Vec3 vec3_at(const std::vector<float> (&values)[3], size_t i) {
  return {values[0][i], values[1][i], values[2][i]};
}

/// The properties of a channel in the file.
std::vector<std::string> properties(const Values& channel) {
  if (channel.type == Type::kFloat) return {channel.name};
  const std::string_view ends = channel.type == Type::kColor ? "rgb" : "xyz";
  std::vector<std::string> names;
  for (char end : ends)
    names.push_back(channel.name + '_' + end);
  return names;
}

/// A colour that clouds have a column for.
std::vector<Color>* column_of(PointCloud& cloud, const Values& channel) {
  if (channel.type != Type::kColor) return nullptr;
  return channel.name == "irradiance" ? &cloud.irradiance
         : channel.name == "albedo"   ? &cloud.albedo
                                      : nullptr;
}

bool is_area(const Values& channel) {
  return channel.type == Type::kFloat && (channel.name == "area" || channel.name == "_area");
}

PointCloud cloud_of(const CloudPoints& points) {
  PointCloud cloud;
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i) {
    const Vec3 normal = vec3_at(points.normal, i);
    cloud.position.push_back(vec3_at(points.position, i));
    cloud.normal.push_back(length2(normal) > 0 ? normalize(normal) : normal);
    cloud.area.push_back(kPi * points.radius[i] * points.radius[i]);
  }
  for (const Values& channel : points.channels) {
    if (is_area(channel)) {
      cloud.area = channel.values[0];
    } else if (std::vector<Color>* column = column_of(cloud, channel)) {
      for (size_t i = 0; i < n; ++i)
        column->push_back(vec3_at(channel.values, i));
    } else {
      size_t component = 0;
      for (std::string& name : properties(channel))
        cloud.channels.push_back({std::move(name), channel.values[component++]});
    }
  }
  return cloud;
}

bool same_columns(const PointCloud& a, const PointCloud& b) {
  return a.irradiance.empty() == b.irradiance.empty() && a.albedo.empty() == b.albedo.empty() &&
         std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    [](const Channel& x, const Channel& y) { return x.name == y.name; });
}

/// Where a channel's numbers stand in a cloud: `stride` floats apart. Null: it has none of the name and type.
struct Source {
  const float* component[3] = {};
  size_t stride = 1;
};

Source source_of(const PointCloud& cloud, const Values& channel) {
  Source source;
  if (is_area(channel)) {
    if (!cloud.area.empty()) source.component[0] = cloud.area.data();
    return source;
  }
  if (channel.type == Type::kColor && (channel.name == "irradiance" || channel.name == "albedo")) {
    const std::vector<Color>& column = channel.name == "albedo" ? cloud.albedo : cloud.irradiance;
    if (column.empty()) return source;
    source.stride = 3;
    for (size_t c = 0; c < 3; ++c)
      source.component[c] = &column[0].x + c;
    return source;
  }
  size_t component = 0;
  for (const std::string& name : properties(channel)) {
    const Channel* found = cloud.find(name);
    if (!found) return {};
    source.component[component++] = found->values.data();
  }
  return source;
}

/// The points that count at a place, with weights whose sum is 1; empty: none.
class Neighbours {
public:
  Neighbours(const PointCloud& cloud, const PointOctree& tree) : cloud_(cloud), tree_(tree) {}

  struct Weighed {
    uint32_t point;
    float weight;
  };
  const std::vector<Weighed>& at(Vec3 x, Vec3 normal, float radius) {
    weighed_.clear();
    // A paraboloid: 1 at the place, 0 where points begin not to count.
    if (radius > 0) {
      tree_.for_each_within(x, radius, [&](uint32_t place, float d2) {
        add(place, normal, (1 - d2 / (radius * radius)) * area(place));
      });
    } else {
      tree_.nearest(x, kNearest + 1, near_);
      const bool all = near_.size() <= kNearest;
      const float edge = near_.empty() ? 0 : near_.back().distance2 * (all ? 1.21f : 1.0f);
      for (const PointOctree::Near& n : near_)
        add(n.place, normal, edge > 0 ? 1 - n.distance2 / edge : 1);
    }
    float sum = 0;
    for (const Weighed& w : weighed_)
      sum += w.weight;
    if (!(sum > 0)) weighed_.clear();
    for (Weighed& w : weighed_)
      w.weight /= sum;
    return weighed_;
  }

private:
  float area(uint32_t place) const {
    const float a = cloud_.area.empty() ? 1 : cloud_.area[tree_.order()[place]];
    return a > 0 ? a : 1;
  }
  /// The two sides of something thin are not mixed.
  void add(uint32_t place, Vec3 normal, float weight) {
    const uint32_t point = tree_.order()[place];
    if (weight <= 0 || (!cloud_.normal.empty() && dot(cloud_.normal[point], normal) < 0)) return;
    weighed_.push_back({point, weight});
  }

  const PointCloud& cloud_;
  const PointOctree& tree_;
  std::vector<PointOctree::Near> near_;
  std::vector<Weighed> weighed_;
};

} // namespace

std::string BakedClouds::bake(const CloudPoints& points) {
  PointCloud fresh = cloud_of(points);
  if (std::string problem = check(fresh); !problem.empty()) return problem;
  std::lock_guard lock(mutex_);
  auto [it, is_new] = written_.try_emplace(std::string(points.file));
  PointCloud& cloud = it->second;
  if (is_new)
    cloud = std::move(fresh);
  else if (same_columns(cloud, fresh))
    append(cloud, fresh);
  else
    return "other calls in this frame write other channels: a file has the same at all its points";
  return {};
}

std::vector<std::string> BakedClouds::finish() {
  std::lock_guard lock(mutex_);
  std::vector<std::string> problems;
  for (auto& [file, cloud] : written_) {
    sort_points(cloud);
    if (auto written = write_point_cloud(file, cloud); !written) problems.push_back(written.error());
  }
  written_.clear();
  return problems;
}

std::shared_ptr<const BakedClouds::Read> BakedClouds::read(std::string_view file) {
  std::shared_ptr<Read> entry;
  {
    std::lock_guard lock(mutex_);
    auto it = read_.find(file);
    if (it == read_.end()) it = read_.emplace(std::string(file), std::make_shared<Read>()).first;
    entry = it->second;
  }
  std::lock_guard turn(entry->turn);
  if (!entry->known) {
    entry->known = true;
    auto cloud = read_point_cloud(find_ ? find_(file) : std::string(file));
    if (cloud) {
      entry->cloud = std::move(*cloud);
      entry->tree = PointOctree(entry->cloud.position);
    } else {
      entry->problem = cloud.error();
    }
  }
  return entry;
}

std::string BakedClouds::look_up(CloudPoints& points, std::vector<char>& found) {
  found.assign(points.size(), 0);
  const auto file = read(points.file);
  if (!file->problem.empty()) return file->problem;
  std::vector<Source> sources;
  for (const Values& channel : points.channels) {
    sources.push_back(source_of(file->cloud, channel));
    if (!sources.back().component[0])
      return fmt::format("it has no channel \"{} {}\"", slvm::type_name(channel.type), channel.name);
  }
  Neighbours neighbours(file->cloud, file->tree);
  for (size_t i = 0; i < points.size(); ++i) {
    const auto& near =
        neighbours.at(vec3_at(points.position, i), vec3_at(points.normal, i), points.radius[i]);
    if (near.empty()) continue;
    found[i] = 1;
    for (size_t k = 0; k < sources.size(); ++k)
      for (size_t c = 0; c < 3 && sources[k].component[c]; ++c) {
        float sum = 0;
        for (const Neighbours::Weighed& w : near)
          sum += w.weight * sources[k].component[c][w.point * sources[k].stride];
        points.channels[k].values[c][i] = sum;
      }
  }
  return {};
}

} // namespace subsurface
