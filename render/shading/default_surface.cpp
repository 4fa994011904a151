// The built-in default surface.
#include "render/shading/default_surface.h"

#include "render/state/math.h"

#include <cmath>

namespace render {

void shade_by_default(slvm::Grid& grid) {
  using slvm::Global;
  float* Ci = grid.varying(Global::kCi);
  float* Oi = grid.varying(Global::kOi);
  const slvm::Planes &N = grid.variable(Global::kN), &I = grid.variable(Global::kI),
                     &Cs = grid.variable(Global::kCs), &Os = grid.variable(Global::kOs);
  size_t pitch = grid.pitch();
  for (size_t k = 0; k < grid.points(); ++k) {
    Vec3 n(N.get(0, k), N.get(1, k), N.get(2, k)), i(I.get(0, k), I.get(1, k), I.get(2, k));
    float lengths = glm::length(n) * glm::length(i);
    float facing = lengths > 0 ? std::abs(glm::dot(n, i)) / lengths : 0.0f;
    for (size_t c = 0; c < 3; ++c) {
      Oi[c * pitch + k] = Os.get(c, k);
      Ci[c * pitch + k] = Os.get(c, k) * Cs.get(c, k) * facing;
    }
  }
}

} // namespace render
