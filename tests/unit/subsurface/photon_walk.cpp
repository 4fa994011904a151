#include "tests/unit/subsurface/photon_walk.h"

#include "stdlib/subsurface/phase.h"
#include "stdlib/subsurface/random.h"

#include <algorithm>
#include <cmath>

namespace subsurface::test {
namespace {

/// In double: long walks add up many small steps.
struct Place {
  double x = 0, y = 0, depth = 0;
};

/// One photon's way. Absorption takes weight away; light ones end by roulette.
class Photon {
public:
  Photon(const Medium& medium, Random& random) : medium_(medium), random_(random) {}

  /// Runs until it leaves (true) or is gone. Below the surface z is negative.
  bool run() {
    while (true) {
      double length = -std::log1p(-random_.unit()) / medium_.sigma_t();
      while (step(length))
        if (left_) return true;
      weight *= medium_.albedo();
      ++events;
      direction_ = scatter_direction(direction_, random_.unit(), random_.unit(), medium_.g);
      if (weight >= 0.01) continue;
      if (random_.unit() >= 0.1) return false;
      weight *= 10;
    }
  }

  double radius() const { return std::hypot(place_.x, place_.y); }
  double weight = 1;
  int events = 0;

private:
  /// Goes on by `length`, or to the surface: then true, with what is left of the length.
  bool step(double& length) {
    const double up = static_cast<double>(direction_.z);
    const bool meets = up > 0 && place_.depth < length * up;
    const double way = meets ? place_.depth / up : length;
    place_.x += way * static_cast<double>(direction_.x);
    place_.y += way * static_cast<double>(direction_.y);
    place_.depth = meets ? 0 : place_.depth - way * up;
    if (!meets) return false;
    length -= way;
    left_ = random_.unit() >= fresnel_reflectance(up, 1 / medium_.eta);
    direction_.z = -direction_.z;
    return true;
  }

  const Medium& medium_;
  Random& random_;
  Place place_;
  Vec3 direction_{0, 0, -1};
  bool left_ = false;
};

} // namespace

WalkResult walk_photons(const Medium& medium, const WalkOptions& options) {
  Random random(options.seed);
  WalkResult result;
  result.rings.resize(options.radii.size());
  double squares = 0, events = 0;
  const auto n = static_cast<double>(options.photons);
  for (size_t i = 0; i < options.photons; ++i) {
    Photon photon(medium, random);
    if (!photon.run()) continue;
    if (photon.events == 0) continue; // never: it entered downwards
    result.reflected += photon.weight / n;
    squares += photon.weight * photon.weight / n;
    events += photon.weight * photon.events / n;
    if (photon.events == 1) result.single += photon.weight / n;
    const auto ring = std::upper_bound(options.radii.begin(), options.radii.end(), photon.radius());
    if (ring != options.radii.end())
      result.rings[static_cast<size_t>(ring - options.radii.begin())] += photon.weight / n;
  }
  result.deviation = std::sqrt((squares - result.reflected * result.reflected) / n);
  result.events = result.reflected > 0 ? events / result.reflected : 0;
  return result;
}

double exact_plane_albedo(double albedo, double mu) {
  constexpr int kPoints = 400;
  const double rest = std::sqrt(1 - albedo);
  std::vector<double> h(kPoints, 1.0);
  auto at = [](int i) { return (i + 0.5) / kPoints; };
  auto next = [&](double x) {
    double sum = 0;
    for (int j = 0; j < kPoints; ++j)
      sum += at(j) * h[static_cast<size_t>(j)] / (x + at(j)) / kPoints;
    return 1 / (rest + albedo / 2 * sum);
  };
  for (int pass = 0; pass < 200; ++pass) {
    std::vector<double> better(kPoints);
    for (int i = 0; i < kPoints; ++i)
      better[static_cast<size_t>(i)] = next(at(i));
    h = std::move(better);
  }
  return 1 - next(mu) * rest;
}

} // namespace subsurface::test
