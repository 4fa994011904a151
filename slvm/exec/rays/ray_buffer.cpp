// Making rays: this is done for every ray there is, so that it goes array by array, without branches.
#include "slvm/exec/rays/ray_buffer.h"

#include "slvm/exec/rays/sample_sequence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slvm {
namespace {

/// Sine and cosine of a part of a turn, from 0 to 1, with an error below 4e-7: Taylor's polynomials of an eighth.
inline void sine_and_cosine(float turn, float& sine, float& cosine) {
  const float quarters = turn * 4;
  const int quarter = static_cast<int>(quarters + 0.5f);
  const float x = (quarters - static_cast<float>(quarter)) * (std::numbers::pi_v<float> / 2), x2 = x * x;
  const float s = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 - x2 / 5040)));
  const float c = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 / 40320)));
  const float a = quarter & 1 ? c : s, b = quarter & 1 ? s : c;
  sine = quarter & 2 ? -a : a;
  cosine = (quarter + 1) & 2 ? -b : b;
}

const float* start(const PointArray& a) {
  return a.empty() ? nullptr : a.data();
}

} // namespace

template <class F> void RayBuffer::each_array(F&& f) {
  for (PointArray* a : {&turn_, &radius_, &max_distance_, &bias_})
    f(*a);
  for (PointTriples* t :
       {&origin_, &direction_, &weight_, &origin_du_, &origin_dv_, &direction_du_, &direction_dv_})
    for (PointArray& a : *t)
      f(a);
}

void RayBuffer::clear() {
  point_.clear();
  place_.clear();
  sample_.clear();
  each_array([](PointArray& a) { a.clear(); });
}

void RayBuffer::add(const RaySource& source, std::span<const uint32_t> places, uint32_t sample) {
  const size_t first = size();
  for (uint32_t i : places)
    if (source.samples[i] > sample && source.shoots[i]) place_.push_back(i);
  const size_t end = place_.size();
  point_.resize(end);
  sample_.resize(end, sample);
  auto copy = [&](const PointArray& from, PointArray& to) {
    if (from.empty()) return;
    to.resize(end);
    for (size_t r = first; r < end; ++r)
      to[r] = from[place_[r]];
  };
  for (size_t r = first; r < end; ++r)
    point_[r] = source.point[place_[r]];
  copy(source.bias, bias_);
  copy(source.max_distance, max_distance_);
  for (size_t c = 0; c < 3; ++c) {
    copy(source.origin[c], origin_[c]);
    copy(source.weight[c], weight_[c]);
  }
  const SobolSample numbers(sample);
  turn_.resize(end);
  radius_.resize(end);
  for (size_t r = first; r < end; ++r) {
    const uint32_t seed = source.seed[place_[r]];
    turn_[r] = scrambled(numbers.bits[static_cast<size_t>(SampleUse::kTurn)],
                         scramble_seed(seed, SampleUse::kTurn));
    radius_[r] = scrambled(numbers.bits[static_cast<size_t>(SampleUse::kRadius)],
                           scramble_seed(seed, SampleUse::kRadius));
  }
  aim(source, first);
  if (!source.base.empty()) spread_origins(source, first, sample);
  if (source.differentials) add_differentials(source, first);
}

// A point on the sphere's part by equal areas (Archimedes: z is uniform), or on the disk below it (by Malley's
// method, as dense as the cosine).
void RayBuffer::aim(const RaySource& source, size_t first) {
  const size_t end = size();
  for (PointArray& component : direction_)
    component.resize(end);
  if (source.cosine_of_angle.empty()) {
    for (size_t c = 0; c < 3; ++c)
      for (size_t r = first; r < end; ++r)
        direction_[c][r] = source.axis[c][place_[r]];
    return;
  }
  for (size_t r = first; r < end; ++r) {
    const size_t i = place_[r];
    float sine, cosine;
    sine_and_cosine(turn_[r], sine, cosine);
    float across, along;
    if (source.cosine) {
      const float squared = radius_[r] * source.squared_sine[i];
      across = std::sqrt(squared);
      along = std::sqrt(1 - squared);
    } else {
      along = 1 - radius_[r] * (1 - source.cosine_of_angle[i]);
      across = std::sqrt(std::max(0.0f, (1 - along) * (1 + along)));
    }
    const float x = across * cosine, y = across * sine;
    for (size_t c = 0; c < 3; ++c)
      direction_[c][r] = x * source.tangent[c][i] + y * source.bitangent[c][i] + along * source.axis[c][i];
  }
}

void RayBuffer::spread_origins(const RaySource& source, size_t first, uint32_t sample) {
  const SobolSample numbers(sample);
  for (size_t r = first; r < size(); ++r) {
    const size_t i = place_[r];
    auto offset = [&](SampleUse use) {
      return source.base[i] *
             (scrambled(numbers.bits[static_cast<size_t>(use)], scramble_seed(source.seed[i], use)) - 0.5f);
    };
    const float u = offset(SampleUse::kBaseU), v = offset(SampleUse::kBaseV);
    for (size_t c = 0; c < 3; ++c)
      origin_[c][r] += u * source.origin_u[c][i] + v * source.origin_v[c][i];
  }
}

// From one point to the next (Igehy 1999, section 3.1.1), wider by the sample's part of the cone; narrower where
// several samples share the element.
void RayBuffer::add_differentials(const RaySource& source, size_t first) {
  for (PointTriples* t : {&origin_du_, &origin_dv_, &direction_du_, &direction_dv_})
    for (PointArray& component : *t)
      component.resize(size());
  for (size_t r = first; r < size(); ++r) {
    const size_t i = place_[r];
    const float share = 1 / std::sqrt(static_cast<float>(source.samples[i]));
    const float part = source.base.empty() ? 1.0f : 1 - source.base[i] * (1 - share);
    const float spread = source.spread.empty() ? 0.0f : source.spread[i];
    float z[3] = {direction_[0][r], direction_[1][r], direction_[2][r]}, across[2][3];
    if (spread > 0) directions_across(z, across[0], across[1]);
    float turn[2] = {};
    for (size_t c = 0; c < 3; ++c) {
      origin_du_[c][r] = part * source.origin_u[c][i];
      origin_dv_[c][r] = part * source.origin_v[c][i];
      turn[0] += source.axis_u[c][i] * source.axis_u[c][i];
      turn[1] += source.axis_v[c][i] * source.axis_v[c][i];
    }
    for (size_t k = 0; k < 2; ++k) {
      const PointTriples& own = k == 0 ? source.axis_u : source.axis_v;
      PointTriples& out = k == 0 ? direction_du_ : direction_dv_;
      const float wide = std::sqrt(turn[k] + spread * spread), narrow = std::sqrt(turn[k]);
      for (size_t c = 0; c < 3; ++c)
        out[c][r] = narrow > 1e-3f * wide ? own[c][i] * (wide / narrow) : spread > 0 ? across[k][c] * wide : 0.0f;
    }
  }
}

void RayBuffer::retain(const std::vector<uint32_t>& kept) {
  auto keep = [&](auto& a) {
    if (a.empty()) return;
    for (size_t r = 0; r < kept.size(); ++r)
      a[r] = a[kept[r]];
    a.resize(kept.size());
  };
  keep(point_);
  keep(place_);
  keep(sample_);
  each_array(keep);
}

RayBatch RayBuffer::batch() const {
  RayBatch b;
  b.count = size();
  for (size_t c = 0; c < 3; ++c) {
    b.origin[c] = origin_[c].data();
    b.direction[c] = direction_[c].data();
    b.origin_du[c] = start(origin_du_[c]);
    b.origin_dv[c] = start(origin_dv_[c]);
    b.direction_du[c] = start(direction_du_[c]);
    b.direction_dv[c] = start(direction_dv_[c]);
    b.weight[c] = start(weight_[c]);
  }
  b.max_distance = start(max_distance_);
  b.bias = start(bias_);
  b.point = point_.data();
  b.sample = sample_.data();
  return b;
}

} // namespace slvm
