// What the calls of a loop over rays do: announcing it, and bringing a round's values to its points.
#include "slvm/exec/rays/gather.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace slvm {
namespace {

/// f(ray, to): stores a ray's value; the variable keeps what it has where it returns false.
template <class F>
void store_rays(const RayBuffer& rays, size_t first, size_t last, const Operand& out, size_t planes,
                F&& value) {
  float x[16];
  for (size_t r = first; r < last; ++r)
    for (size_t i = 0; i < planes; i += std::size(x)) {
      const size_t count = std::min(planes - i, std::size(x));
      if (!value(r, i, count, x)) break;
      for (size_t k = 0; k < count; ++k)
        put(out, i + k, rays.point(r), x[k]);
      if (!out.step && i + count >= planes) return; // that of the first point
    }
}

/// Registers hold the variable's old value first.
void keep_old(const ShaderRun& run, const Operand& out, const Operand& before, size_t planes) {
  if (out.data == before.data) return;
  for (size_t i = 0; i < planes; ++i) {
    if (out.step && before.step)
      std::memmove(out.plane(i), before.plane(i), run.pitch * sizeof(float));
    else
      std::fill_n(out.plane(i), out.step ? run.pitch : kMaxLanes, *before.plane(i));
  }
}

} // namespace

void GatherLoop::store_found(const RayValue& value, const Operand& out, size_t planes) const {
  size_t last = last_;
  if (!out.step) { // that of the first point
    const auto begin = value.found.begin();
    last = static_cast<size_t>(std::find(begin + static_cast<std::ptrdiff_t>(first_),
                                         begin + static_cast<std::ptrdiff_t>(last_), 1) -
                               begin);
    for (size_t i = 0; i < planes && last < last_; ++i)
      put(out, i, 0, value.data[i * rays_.size() + last]);
    return;
  }
  const uint8_t* found = value.found.data();
  const uint32_t* points = rays_.points();
  for (size_t i = 0; i < planes; ++i) {
    const float* from = value.data.data() + i * rays_.size();
    float* to = out.plane(i);
    for (size_t r = first_; r < last; ++r)
      if (found[r]) to[points[r]] = from[r];
  }
}

void GatherLoop::store_value(const GridCall& call) const {
  const GridOperand &out = call.operands[0], &name = call.operands[1], &before = call.operands[2];
  const uint32_t elements = out.array ? out.planes.elements : 0;
  const size_t planes = static_cast<size_t>(components(out.type)) * std::max(elements, 1u);
  if (!out.array) keep_old(call.run, out.planes, before.planes, planes);
  const auto token = std::bit_cast<uint32_t>(*name.planes.data);
  auto v = std::find_if(values_.begin(), values_.end(), [&](const RayValue& value) {
    return value.token == token && value.output.type == out.type && value.output.elements == elements;
  });
  if (v == values_.end()) return;
  auto store = [&](auto&& value) { store_rays(rays_, first_, last_, out.planes, planes, value); };
  auto triple = [&](auto&& component) {
    if (planes != 3) return;
    store([&](size_t r, size_t, size_t, float* x) {
      for (size_t c = 0; c < 3; ++c)
        x[c] = component(c, r);
      return true;
    });
  };
  auto number = [&](auto&& of_ray) {
    if (planes == 1) store([&](size_t r, size_t, size_t, float* x) { return of_ray(r, *x); });
  };
  auto hit = [&](size_t r) {
    return distance_[r] >= 0 && distance_[r] < std::numeric_limits<float>::infinity();
  };
  switch (v->of) {
  case RayValue::Of::kHit:
    if (v->found.size() == rays_.size()) store_found(*v, out.planes, planes);
    return;
  case RayValue::Of::kOrigin: return triple([&](size_t c, size_t r) { return rays_.origin(c, r); });
  case RayValue::Of::kDirection:
  case RayValue::Of::kMapDirection: return triple([&](size_t c, size_t r) { return rays_.direction(c, r); });
  case RayValue::Of::kLength:
    return number([&](size_t r, float& x) {
      x = distance_[r];
      return mode_ == Mode::kRays && hit(r);
    });
  case RayValue::Of::kBias:
    return number([&](size_t r, float& x) {
      x = rays_.bias(r) >= 0 ? rays_.bias(r) : attribute_bias_;
      return true;
    });
  case RayValue::Of::kRandomPair:
    return triple([&](size_t c, size_t r) {
      return c == 0 ? rays_.turn(r) : c == 1 ? rays_.radius(r) : 0.0f;
    });
  case RayValue::Of::kMapColour:
    if (from_map_) triple([&](size_t c, size_t r) { return colour_[c][r]; });
    return;
  case RayValue::Of::kMapSolidAngle: // the sample's part of all directions
    if (from_map_)
      number([&](size_t r, float& x) {
        x = 1 / (density_[r] * static_cast<float>(source_.samples[rays_.place(r)]));
        return true;
      });
    return;
  }
}

namespace grid_ops {

void gather_rays(const GridCall& call) {
  call.run.gathers.announce().begin(call, GatherLoop::Form::kGather);
}
void traverse_ray(const GridCall& call) {
  call.run.gathers.announce().begin(call, GatherLoop::Form::kTraverse);
}

void gather_hit(const GridCall& call) {
  const GatherLoop* loop = call.run.gathers.current();
  const Operand& out = call.operands[0].planes;
  if (loop && out.step)
    call.run.state.machine.kernels().bools_of_mask(out.data, loop->hits(), call.run.pitch);
  else
    std::fill_n(out.data, out.step ? call.run.pitch : kMaxLanes, 0.0f);
}

void gather_value(const GridCall& call) {
  if (const GatherLoop* loop = call.run.gathers.current()) loop->store_value(call);
}

} // namespace grid_ops
} // namespace slvm
