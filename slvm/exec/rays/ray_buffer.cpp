// Making rays: this is done for every ray there is, so that it goes array by array, without branches.
#include "slvm/exec/rays/ray_buffer.h"

#include "slvm/kernels/draw_numbers.h"
#include "slvm/support/turn.h"

#include <algorithm>
#include <cmath>

namespace slvm {
namespace {

constexpr size_t kBlock = 256; ///< rays: what loops hand on stays in the nearest cache

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

namespace {

/// Whether these places are all of the source's, in order, and each shoots this sample.
bool is_all(const RaySource& source, std::span<const uint32_t> places, uint32_t sample) {
  if (places.size() != source.size()) return false;
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i] != i || source.samples[i] <= sample || !source.shoots[i]) return false;
  return true;
}

/// A new part of an array that the rays from `first` on fill.
template <class T> T* grow(std::vector<T>& a, size_t first, size_t count) {
  a.resize(first + count);
  return a.data() + first;
}

} // namespace

void RayBuffer::add(const RaySource& source, std::span<const uint32_t> places, uint32_t sample) {
  const size_t first = size();
  if (is_all(source, places, sample)) {
    place_.insert(place_.end(), places.begin(), places.end());
    fill(source, first, sample, [](size_t r) { return r; });
    return;
  }
  for (uint32_t i : places)
    if (source.samples[i] > sample && source.shoots[i]) place_.push_back(i);
  fill(source, first, sample, [place = place_.data() + first](size_t r) { return size_t{place[r]}; });
}

// `at`: the place in the source of the r-th new ray.
template <class At> void RayBuffer::fill(const RaySource& source, size_t first, uint32_t sample, At at) {
  const size_t count = place_.size() - first;
  auto copy = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    auto* out = grow(to, first, count);
    for (size_t r = 0; r < count; ++r)
      out[r] = from[at(r)];
  };
  sample_.resize(first + count, sample);
  copy(source.point, point_);
  copy(source.bias, bias_);
  copy(source.max_distance, max_distance_);
  for (size_t c = 0; c < 3; ++c) {
    copy(source.origin[c], origin_[c]);
    copy(source.weight[c], weight_[c]);
  }
  const SobolSample numbers(sample);
  draw(source, numbers, SampleUse::kTurn, grow(turn_, first, count), count, at);
  draw(source, numbers, SampleUse::kRadius, grow(radius_, first, count), count, at);
  aim(source, first, count, at);
  if (!source.base.empty()) spread_origins(source, numbers, first, count, at);
  if (!source.differentials) return;
  for (size_t c = 0; c < 3; ++c) {
    copy(source.ray_origin_u[c], origin_du_[c]);
    copy(source.ray_origin_v[c], origin_dv_[c]);
  }
  widen(source, first, count, at);
}

template <class At>
void RayBuffer::draw(const RaySource& source, const SobolSample& numbers, SampleUse use, float* out,
                     size_t count, At at) {
  const uint32_t bits = numbers.bits[static_cast<size_t>(use)];
  const uint32_t* seeds = source.seeds[static_cast<size_t>(use)].data();
  uint32_t some[kBlock];
  for (size_t from = 0; from < count; from += kBlock) {
    const size_t n = std::min(kBlock, count - from);
    for (size_t k = 0; k < n; ++k)
      some[k] = seeds[at(from + k)];
    draw_numbers(bits, some, n, out + from);
  }
}

// A point on the sphere's part by equal areas (Archimedes: z is uniform), or on the disk below it (by
// Malley's method, as dense as the cosine).
template <class At> void RayBuffer::aim(const RaySource& source, size_t first, size_t count, At at) {
  float* out[3];
  for (size_t c = 0; c < 3; ++c) {
    out[c] = grow(direction_[c], first, count);
    const float* axis = source.axis[c].data();
    for (size_t r = 0; r < count && source.cosine_of_angle.empty(); ++r)
      out[c][r] = axis[at(r)];
  }
  if (source.cosine_of_angle.empty()) return;
  const float *turn = turn_.data() + first, *radius = radius_.data() + first;
  float x[kBlock], y[kBlock], z[kBlock];
  for (size_t from = 0; from < count; from += kBlock) {
    const size_t n = std::min(kBlock, count - from);
    if (source.cosine) {
      const float* squared_sine = source.squared_sine.data();
      for (size_t k = 0; k < n; ++k) {
        const float squared = radius[from + k] * squared_sine[at(from + k)];
        x[k] = std::sqrt(squared);
        z[k] = std::sqrt(1 - squared);
      }
    } else {
      const float* edge = source.cosine_of_angle.data();
      for (size_t k = 0; k < n; ++k) {
        const float along = 1 - radius[from + k] * (1 - edge[at(from + k)]);
        const float squared = (1 - along) * (1 + along);
        x[k] = std::sqrt(squared > 0 ? squared : 0.0f);
        z[k] = along;
      }
    }
    for (size_t k = 0; k < n; ++k) {
      float sine, cosine;
      sine_and_cosine(turn[from + k], sine, cosine);
      y[k] = x[k] * sine;
      x[k] *= cosine;
    }
    for (size_t c = 0; c < 3; ++c) {
      const float *t = source.tangent[c].data(), *b = source.bitangent[c].data(), *a = source.axis[c].data();
      for (size_t k = 0; k < n; ++k) {
        const size_t i = at(from + k);
        out[c][from + k] = x[k] * t[i] + y[k] * b[i] + z[k] * a[i];
      }
    }
  }
}

template <class At>
void RayBuffer::spread_origins(const RaySource& source, const SobolSample& numbers, size_t first,
                               size_t count, At at) {
  std::vector<float> offset(count);
  for (SampleUse use : {SampleUse::kBaseU, SampleUse::kBaseV}) {
    draw(source, numbers, use, offset.data(), count, at);
    for (size_t r = 0; r < count; ++r)
      offset[r] = source.base[at(r)] * (offset[r] - 0.5f);
    const PointTriples& side = use == SampleUse::kBaseU ? source.origin_u : source.origin_v;
    for (size_t c = 0; c < 3; ++c) {
      float* out = origin_[c].data() + first;
      const float* along = side[c].data();
      for (size_t r = 0; r < count; ++r)
        out[r] += offset[r] * along[at(r)];
    }
  }
}

template <class At> void RayBuffer::widen(const RaySource& source, size_t first, size_t count, At at) {
  for (size_t k = 0; k < 2; ++k)
    for (size_t c = 0; c < 3; ++c) {
      float* out = grow((k == 0 ? direction_du_ : direction_dv_)[c], first, count);
      const float* turns = (k == 0 ? source.axis_u : source.axis_v)[c].data();
      const float* scale = source.turn_scale[k].data();
      for (size_t r = 0; r < count; ++r)
        out[r] = scale[at(r)] * turns[at(r)];
    }
  for (size_t r = 0; r < count && source.any_across; ++r) {
    float z[3] = {direction_[0][first + r], direction_[1][first + r], direction_[2][first + r]}, x[3], y[3];
    directions_across(z, x, y);
    for (size_t c = 0; c < 3; ++c) {
      direction_du_[c][first + r] += source.across[0][at(r)] * x[c];
      direction_dv_[c][first + r] += source.across[1][at(r)] * y[c];
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
