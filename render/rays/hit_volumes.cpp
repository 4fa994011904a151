// Choosing and running volume shaders.
#include "render/rays/hit_volumes.h"

#include <algorithm>

namespace render {

namespace {

using slvm::Global;

/// Along a direction against the outward normal of a point; 0 where there is none.
float along_normal(const slvm::Grid& grid, size_t point, Vec3 direction) {
  const slvm::Planes& Ng = grid.variable(Global::kNg);
  if (!Ng.data || point >= grid.points()) return 0;
  return glm::dot(direction, Vec3(Ng.get(0, point), Ng.get(1, point), Ng.get(2, point)));
}

} // namespace

std::vector<const slvm::Instance*> possible_volumes(const slvm::ShaderSet& from, const slvm::ShaderSet& hit) {
  std::vector<const slvm::Instance*> out;
  for (const slvm::Instance* v : {from.interior, from.exterior, hit.interior, hit.exterior, hit.atmosphere})
    if (v && std::find(out.begin(), out.end(), v) == out.end()) out.push_back(v);
  return out;
}

void HitVolumes::find(const slvm::ShadingState& from, const slvm::ShaderSet& set, const slvm::Grid& grid,
                      const HitRays& rays, std::span<const HitRay> hits) {
  volumes_.assign(hits.size(), set.atmosphere);
  const slvm::ShaderSet& shot = from.shaders;
  if (!shot.interior && !shot.exterior && !set.interior && !set.exterior) return;
  for (size_t i = 0; i < hits.size(); ++i) {
    const Vec3 direction = rays.direction(hits[i]);
    const slvm::Instance* v =
        along_normal(from.grid, hits[i].point, direction) < 0 ? shot.interior : shot.exterior;
    if (!v) v = along_normal(grid, i, direction) > 0 ? set.interior : set.exterior;
    if (v) volumes_[i] = v;
  }
}

void HitVolumes::keep(const slvm::Grid& grid, std::vector<float>& planes) const {
  planes.resize(6 * grid.pitch());
  float* to = planes.data();
  for (Global g : {Global::kCi, Global::kOi})
    to = std::copy_n(grid.variable(g).data, 3 * grid.pitch(), to);
}

void HitVolumes::shade(slvm::ShadingContext& context, slvm::Grid& grid,
                       const std::function<void(const slvm::Instance&, std::span<const uint32_t>)>& done) {
  const size_t n = volumes_.size(), pitch = grid.pitch();
  grid.varying(Global::kCi);
  grid.varying(Global::kOi);
  bool same = std::all_of(volumes_.begin(), volumes_.end(), [&](auto* v) { return v == volumes_[0]; });
  if (!same) {
    keep(grid, before_);
    after_ = before_;
  }
  std::vector<const slvm::Instance*> left(volumes_.begin(), volumes_.end());
  std::sort(left.begin(), left.end());
  left.erase(std::unique(left.begin(), left.end()), left.end());
  for (const slvm::Instance* v : left) {
    if (!v) continue;
    lanes_.clear();
    for (uint32_t i = 0; i < n; ++i)
      if (volumes_[i] == v) lanes_.push_back(i);
    context.shade_volume(*v);
    done(*v, lanes_);
    if (same) return;
    size_t plane = 0;
    for (Global g : {Global::kCi, Global::kOi}) {
      float* from = grid.varying(g);
      for (size_t c = 0; c < 3; ++c, ++plane) {
        for (uint32_t i : lanes_)
          after_[plane * pitch + i] = from[c * pitch + i];
        std::copy_n(&before_[plane * pitch], pitch, from + c * pitch);
      }
    }
  }
  if (same) return;
  std::copy_n(after_.data(), 3 * pitch, grid.varying(Global::kCi));
  std::copy_n(after_.data() + 3 * pitch, 3 * pitch, grid.varying(Global::kOi));
}

} // namespace render
