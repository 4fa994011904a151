// Defaults that need more than an initialiser.
#include "render/state/attributes.h"

namespace render {

CubicBasis bezier_basis() {
  return {{{-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0}}, 3};
}

} // namespace render
