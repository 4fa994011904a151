#include "stdlib/subsurface/sample_tables.h"

#include "stdlib/subsurface/random.h"
#include "stdlib/subsurface/sampling.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace subsurface {
namespace {

struct Place {
  double x = 0, y = 0;
  double radius2() const { return x * x + y * y; }
};

Place on_disc(Random& random) {
  Place p;
  do {
    p.x = 2 * random.unit() - 1;
    p.y = 2 * random.unit() - 1;
  } while (p.radius2() > 1);
  return p;
}

std::vector<Place> best_candidates(const SampleTableOptions& options, Random& random) {
  std::vector<Place> points{on_disc(random)};
  while (static_cast<int>(points.size()) < options.samples) {
    Place best;
    double widest = -1;
    for (size_t c = 0; c < points.size() * static_cast<size_t>(options.candidates); ++c) {
      const Place p = on_disc(random);
      double nearest = 8;
      for (const Place& q : points)
        nearest = std::min(nearest, Place{p.x - q.x, p.y - q.y}.radius2());
      if (nearest > widest) widest = nearest, best = p;
    }
    points.push_back(best);
  }
  return points;
}

} // namespace

SampleTables make_sample_tables(const SampleTableOptions& options) {
  SampleTables tables;
  for (int table = 0; table < options.tables; ++table) {
    Random random(options.seed + static_cast<uint64_t>(table));
    const std::vector<Place> points = best_candidates(options, random);
    std::vector<size_t> by_radius(points.size()), rank(points.size());
    std::iota(by_radius.begin(), by_radius.end(), size_t{0});
    std::sort(by_radius.begin(), by_radius.end(),
              [&](size_t a, size_t b) { return points[a].radius2() < points[b].radius2(); });
    for (size_t k = 0; k < by_radius.size(); ++k)
      rank[by_radius[k]] = k;
    for (size_t i = 0; i < points.size(); ++i) {
      const double share = (static_cast<double>(rank[i]) + 0.5) / static_cast<double>(points.size());
      const double radius = diffusion_radius(share), angle = std::atan2(points[i].y, points[i].x);
      tables.x.push_back(static_cast<float>(radius * std::cos(angle)));
      tables.y.push_back(static_cast<float>(radius * std::sin(angle)));
    }
  }
  return tables;
}

std::string format_sample_tables(const SampleTables& tables, const SampleTableOptions& options) {
  std::string out;
  const std::pair<const char*, const std::vector<float>*> columns[] = {{"scattdiffdist1", &tables.x},
                                                                       {"scattdiffdist2", &tables.y}};
  for (const auto& [name, values] : columns) {
    out += fmt::format("uniform float {}[{}] = {{\n", name, values->size());
    for (size_t i = 0; i < values->size(); ++i) {
      const bool last = i + 1 == values->size(), row = (i + 1) % static_cast<size_t>(options.samples) == 0;
      out += fmt::format("{:.6f}{}", (*values)[i], last ? "" : row ? ",\n" : ",");
    }
    out += "\n};\n";
  }
  return out;
}

} // namespace subsurface
