// Shoots the rays of hemisphere queries and sums them up.
#pragma once

#include "render/rays/hemisphere_aim.h"
#include "render/rays/shooter.h"

#include <memory>
#include <string>

namespace render {

class HemisphereSampler {
public:
  /// `interpolated`: samples are used at other points, too, and need distances and gradients.
  HemisphereSampler(RayTracer& tracer, const slvm::ShadingState& state, const slvm::HemisphereQuery& query,
                    bool interpolated);
  ~HemisphereSampler();

  /// Whether any rays may be shot.
  bool may_shoot() const { return shooter_.may_shoot; }
  /// Whether what this point of the query sees weighs enough.
  bool is_heavy_enough(size_t point) const {
    return !shooter_.too_light(shooter_.weight(query_.weight, point, point));
  }
  void sample(std::span<const HemispherePoint> points, std::span<HemisphereSample> out);
  /// Stands for everything but the place that a sample depends on.
  uint64_t call_hash(const HemispherePoint& point) const;
  /// Why the environment map cannot be looked up, or "".
  const std::string& problem() const { return problem_; }

private:
  /// What rays brought: for all cells of a point, then for those of the next.
  struct Cells {
    std::vector<Vec3> direction;
    std::vector<float> distance, blocked;
    std::vector<Color> light, map; ///< where rays bring any
    std::vector<uint8_t> shot;
    void reset(size_t count, bool coloured) {
      direction.resize(count);
      distance.assign(count, kInfinity);
      blocked.assign(count, 0.0f);
      light.assign(coloured ? count : 0, Color(0.0f));
      map.assign(coloured ? count : 0, Color(0.0f));
      shot.assign(count, 0);
    }
    /// Makes a cell that was left out like another one.
    void copy(size_t from, size_t to) {
      distance[to] = distance[from];
      blocked[to] = blocked[from];
      if (light.empty()) return;
      light[to] = light[from];
      map[to] = map[from];
    }
  };
  struct Rays;

  void push_rays(Rays& rays, const HemispherePoint& point, size_t index);
  void first_rays(std::span<const HemispherePoint> points, Rays& rays);
  void more_rays(std::span<const HemispherePoint> points, Rays& rays);
  void cast(std::span<const HemispherePoint> points, Rays& rays);
  void look_up_map(Rays& rays);
  void finish(const HemispherePoint& point, size_t index, HemisphereSample& out);
  void gradients(const HemispherePoint& point, size_t first, HemisphereSample& out);
  bool differs(size_t a, size_t b) const;
  float blocked_by(const HemispherePoint& point, float distance) const;
  uint64_t seed_of(const HemispherePoint& point) const;

  RayTracer& tracer_;
  const slvm::ShadingState& state_;
  const slvm::HemisphereQuery& query_;
  RayTracer::Shooter shooter_;
  HemispherePattern pattern_;
  bool interpolated_, wants_light_, wants_map_;
  uint64_t call_ = 0;
  /// Whether it is enough to know if there is anything.
  bool only_blocked() const { return !interpolated_ && !wants_light_ && query_.falloff == 0; }
  /// Whether rays bring anything that is filtered.
  bool needs_width() const { return wants_light_ || wants_map_; }

  Cells cells_;                     ///< of all points being sampled
  std::vector<int> chosen_;         ///< of each block of each point: the cell that is shot first
  std::vector<uint32_t> by_block_;  ///< cells in the order of their blocks
  std::vector<Vec2> around_;        ///< cosine and sine at edges and middles of sectors, in turn
  std::vector<float> by_sector_[3]; ///< sums of gradients
  HemisphereAim aim_;
  std::unique_ptr<Rays> rays_; ///< with its memory
  std::string problem_;
};

} // namespace render
