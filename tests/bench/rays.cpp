#include "tests/bench/rays.h"

#include <algorithm>
#include <cmath>

namespace bench {

BallScene::BallScene() {
  constexpr int kBalls = 64;
  for (int i = 0; i < kBalls; ++i) {
    const auto x = static_cast<float>(i % 8), y = static_cast<float>(i / 8);
    balls_.push_back({{0.6f * (x - 3.5f), 0.6f * (y - 3.5f), 3.5f - 0.1f * x}, 0.03f + 0.001f * y});
  }
}

void BallScene::nearest(const float* const (&origin)[3], const float* const (&direction)[3], size_t count,
                        float* distance, float* colour, uint8_t* found) const {
  for (size_t r = 0; r < count; ++r) {
    const float o[3] = {origin[0][r], origin[1][r], origin[2][r]};
    const float d[3] = {direction[0][r], direction[1][r], direction[2][r]};
    float best = std::numeric_limits<float>::infinity();
    size_t which = 0;
    for (size_t i = 0; i < balls_.size(); ++i) {
      const Ball& b = balls_[i];
      const float x = b.centre[0] - o[0], y = b.centre[1] - o[1], z = b.centre[2] - o[2];
      const float middle = x * d[0] + y * d[1] + z * d[2];
      const float squared = b.squared_radius - (x * x + y * y + z * z) + middle * middle;
      if (squared < 0 || middle < 0) continue;
      const float t = middle - std::sqrt(squared);
      if (t > 0 && t < best) best = t, which = i;
    }
    distance[r] = best;
    if (!colour || best == std::numeric_limits<float>::infinity()) continue;
    found[r] = 1;
    for (size_t c = 0; c < 3; ++c)
      colour[c * count + r] = 0.5f + 0.25f * balls_[which].centre[c];
  }
}

void BallScene::trace(const slvm::ShadingState&, const slvm::RayOptions&, const slvm::RayBatch& batch,
                      std::span<const slvm::RayOutput> outputs, float* distance, slvm::RayCursor*) {
  if (keeps) {
    RayCall& call = kept.emplace_back();
    for (size_t c = 0; c < 3; ++c) {
      call.origin[c].assign(batch.origin[c], batch.origin[c] + batch.count);
      call.direction[c].assign(batch.direction[c], batch.direction[c] + batch.count);
    }
    call.point.assign(batch.point, batch.point + batch.count);
  }
  const bool shades = !outputs.empty();
  nearest(batch.origin, batch.direction, batch.count, distance, shades ? outputs[0].data : nullptr,
          shades ? outputs[0].found : nullptr);
}

namespace {

template <class Add>
void replay(const BallScene& scene, bool colours, size_t points, float* const (&ci)[3], Add&& add) {
  for (float* plane : ci)
    std::fill_n(plane, points, 0.0f);
  std::vector<float> distance, colour;
  std::vector<uint8_t> found;
  for (const RayCall& call : scene.kept) {
    const size_t count = call.point.size();
    const float* const origin[3] = {call.origin[0].data(), call.origin[1].data(), call.origin[2].data()};
    const float* const direction[3] = {call.direction[0].data(), call.direction[1].data(),
                                       call.direction[2].data()};
    distance.resize(count);
    colour.resize(colours ? 3 * count : 0);
    found.assign(colours ? count : 0, 0);
    scene.nearest(origin, direction, count, distance.data(), colours ? colour.data() : nullptr, found.data());
    for (size_t r = 0; r < count; ++r)
      if (distance[r] < std::numeric_limits<float>::infinity()) add(call.point[r], colour.data() + r, count);
  }
}

} // namespace

void occlusion_by_hand(const BallScene& scene, float samples, size_t points, float* const (&ci)[3]) {
  replay(scene, false, points, ci, [&](uint32_t point, const float*, size_t) { ci[0][point] += 1; });
  for (size_t i = 0; i < points; ++i)
    ci[0][i] = ci[1][i] = ci[2][i] = 1 - ci[0][i] / samples;
}

void bleeding_by_hand(const BallScene& scene, float samples, size_t points, float* const (&ci)[3]) {
  replay(scene, true, points, ci, [&](uint32_t point, const float* colour, size_t pitch) {
    for (size_t c = 0; c < 3; ++c)
      ci[c][point] += colour[c * pitch];
  });
  for (float* plane : ci)
    for (size_t i = 0; i < points; ++i)
      plane[i] /= samples;
}

} // namespace bench
