// Finding points, and copying what is known of them.
#include "render/hider/needed_points.h"

#include <algorithm>
#include <bit>

namespace render {

void NeededPoints::find(const ShadedGrid& g, const SamplePattern* samples) {
  const auto nu = static_cast<size_t>(g.nu), nv = static_cast<size_t>(g.nv);
  needed_.assign(g.points(), 0);
  const float *x = g.position.plane(0), *y = g.position.plane(1);
  auto may_be_seen = [&](size_t a, size_t b, size_t c, size_t d) {
    const Vec2 low(std::min({x[a], x[b], x[c], x[d]}), std::min({y[a], y[b], y[c], y[d]})),
        high(std::max({x[a], x[b], x[c], x[d]}), std::max({y[a], y[b], y[c], y[d]}));
    return samples->may_have(low, high);
  };
  for (size_t j = 0, m = 0; j + 1 < nv; ++j)
    for (size_t i = 0; i + 1 < nu; ++i, ++m) {
      const size_t a = j * nu + i, b = a + 1, c = a + nu, d = c + 1;
      if (g.hidden[m] == ShadedGrid::kNotDrawn || (samples && !may_be_seen(a, b, c, d))) continue;
      needed_[a] = 1;
      if (g.smooth) needed_[b] = needed_[c] = needed_[d] = 1;
    }
  points_.clear();
  for (uint32_t k = 0; k < needed_.size(); ++k)
    if (needed_[k]) points_.push_back(k);
}

namespace {

size_t planes_of(const slvm::Planes& p) {
  return static_cast<size_t>(slvm::components(p.type)) * std::max(p.elements, 1u);
}

void copy_points(const slvm::Planes& from, std::span<const uint32_t> points, float* to, size_t pitch) {
  for (size_t c = 0; c < planes_of(from); ++c) {
    const float* values = from.data + c * from.pitch;
    for (size_t k = 0; k < points.size(); ++k)
      to[c * pitch + k] = values[points[k]];
  }
}

slvm::Value uniform_value(const slvm::Planes& p, const slvm::StringPool& strings) {
  slvm::Value out{p.type, p.elements, {}, {}};
  for (size_t c = 0; c < planes_of(p); ++c)
    if (const float value = p.get(c, 0); p.type == slvm::Type::kString)
      out.strings.emplace_back(strings.text(std::bit_cast<uint32_t>(value)));
    else
      out.numbers.push_back(value);
  return out;
}

} // namespace

slvm::Grid& NeededPoints::take(const slvm::Grid& from, slvm::StringPool& strings) {
  grid_.reset(static_cast<int>(points_.size()), 1);
  grid_.lattice = slvm::Lattice::kHits;
  grid_.derivatives = from.derivatives;
  grid_.flip_normals = from.flip_normals;
  grid_.object_to_current = from.object_to_current;
  grid_.id = from.id;
  grid_.user = from.user;
  for (size_t i = 0; i < static_cast<size_t>(slvm::kGlobalCount); ++i) {
    const auto g = static_cast<slvm::Global>(i);
    const slvm::Planes& p = from.variable(g);
    if (!p.data) continue;
    if (p.step)
      copy_points(p, points_, grid_.to_fill(g), grid_.pitch());
    else
      grid_.set_uniform(g, uniform_value(p, strings).numbers);
  }
  for (const auto& [name, p] : from.primvars())
    if (p.step)
      copy_points(p, points_, grid_.add_varying_primvar(name, p.type, p.elements), grid_.pitch());
    else
      grid_.add_uniform_primvar(name, uniform_value(p, strings), strings);
  return grid_;
}

} // namespace render
