#include "stdlib/subsurface/phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace subsurface {

double henyey_greenstein(double cosine, double g) {
  const double base = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * std::numbers::pi * base * std::sqrt(base));
}

double sample_henyey_greenstein(double xi, double g) {
  if (std::abs(g) < 1e-4) return 2 * xi - 1; // the limit; the formula loses all digits
  const double s = (1 - g * g) / (1 - g + 2 * g * xi);
  return std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
}

Vec3 scatter_direction(Vec3 direction, double xi, double xi_around, double g) {
  const double cosine = sample_henyey_greenstein(xi, g), angle = 2 * std::numbers::pi * xi_around;
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return normalize(
      Frame(direction).to_world({static_cast<float>(sine * std::cos(angle)),
                                 static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine)}));
}

} // namespace subsurface
