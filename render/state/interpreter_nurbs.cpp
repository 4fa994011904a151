// NuPatch and TrimCurve.
#include "render/prims/nurbs_pieces.h"
#include "render/prims/typed_vars.h"
#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace render {

namespace {

size_t sum_of(std::span<const int> counts) {
  size_t sum = 0;
  for (int n : counts)
    sum += n > 0 ? static_cast<size_t>(n) : 0;
  return sum;
}

} // namespace

void Interpreter::nu_patch(const RequestCall& call) {
  auto u = NurbsBasis::make(call.integer(0), call.integer(1), call.numbers(2), call.number(3), call.number(4),
                            "u");
  auto v = NurbsBasis::make(call.integer(5), call.integer(6), call.numbers(7), call.number(8), call.number(9),
                            "v");
  for (const auto* basis : {&u, &v})
    if (!*basis) {
      error(call, basis->error());
      return;
    }
  std::vector<TypedParam> vars = primitive_vars(call, *sizes_of(call)); // the bases hold, so the counts do
  std::vector<float> weights = point_weights(vars);
  for (float w : weights)
    if (!(w > 0)) {
      error(call, fmt::format("a weight is {}; they must be positive", w));
      return;
    }
  std::vector<Vec3> P;
  if (!take_positions(call, vars, P)) return;
  auto surface = std::make_shared<NurbsSurface>();
  surface->u = *u;
  surface->v = *v;
  for (size_t i = 0; i < P.size(); ++i) {
    double w = weights.empty() ? 1 : static_cast<double>(weights[i]);
    surface->points.emplace_back(glm::dvec3(P[i]) * w, w);
  }
  const auto& trim = attributes_->trim;
  if (!trim) {
    add_nurbs(surface, nullptr, vars, primitive_state(), scene_.primitives);
    return;
  }
  auto sense = attributes_->named.find("trimcurve:sense");
  bool outside = sense != attributes_->named.end() && !sense->second.strings.empty() &&
                 sense->second.strings[0] == "outside";
  auto used = [&](int knots, int order, float limit, bool low) {
    std::span<const float> k = call.numbers(knots);
    return low ? std::max(limit, k[static_cast<size_t>(order - 1)])
               : std::min(limit, k[k.size() - static_cast<size_t>(order)]);
  };
  glm::dvec2 low(used(2, u->order(), call.number(3), true), used(7, v->order(), call.number(8), true));
  glm::dvec2 high(used(2, u->order(), call.number(4), false), used(7, v->order(), call.number(9), false));
  std::vector<UvQuad> quads = trimmed_square(*trim, low, high, outside);
  add_nurbs(surface, &quads, vars, primitive_state(), scene_.primitives);
}

/// Arguments: curves of each loop; of each curve its order, its knots, parameter range and number of points;
/// the points' u, v and w.
void Interpreter::trim_curve(const RequestCall& call) {
  std::span<const int> ncurves = call.integers(0), order = call.integers(1), n = call.integers(5);
  size_t curves = sum_of(ncurves), points = sum_of(n), knots = points + sum_of(order);
  const std::pair<size_t, size_t> kCounts[] = {{1, curves}, {2, knots},  {3, curves}, {4, curves},
                                               {5, curves}, {6, points}, {7, points}, {8, points}};
  for (auto [i, want] : kCounts) {
    const Argument& a = call.arguments[i];
    size_t have = i == 1 || i == 5 ? a.ints.size() : a.numbers.size();
    if (have != want) {
      error_at(a.where, call,
               fmt::format("'{}' takes {} numbers, found {}", call.info().arguments[i].name, want, have));
      return;
    }
  }
  for (float w : call.numbers(8))
    if (!(w > 0)) {
      error_at(call.arguments[8].where, call, fmt::format("a weight is {}; they must be positive", w));
      return;
    }
  auto region = std::make_shared<TrimRegion>();
  size_t curve = 0, knot = 0, point = 0;
  for (int count : ncurves) {
    TrimLoop& loop = region->loops.emplace_back();
    for (int c = 0; c < count; ++c, ++curve) {
      TrimCurve& out = loop.emplace_back();
      auto own = static_cast<size_t>(std::max(n[curve], 0)),
           degree1 = static_cast<size_t>(std::max(order[curve], 0));
      auto k = call.numbers(2).subspan(knot, own + degree1);
      out.order = order[curve];
      out.knots.assign(k.begin(), k.end());
      out.min = call.numbers(3)[curve];
      out.max = call.numbers(4)[curve];
      for (size_t i = point; i < point + own; ++i)
        out.points.emplace_back(call.numbers(6)[i], call.numbers(7)[i], call.numbers(8)[i]);
      knot += own + degree1;
      point += own;
      auto basis = NurbsBasis::make(n[curve], out.order, out.knots, out.min, out.max, "");
      if (!basis) {
        error(call, fmt::format("curve {}: {}", curve + 1, basis.error()));
        return;
      }
    }
  }
  edit().trim = region->loops.empty() ? nullptr : region;
}

} // namespace render
