// Derived values of the options.
#include "render/state/options.h"

namespace render {

float Options::aspect() const {
  if (frame_aspect) return *frame_aspect;
  return static_cast<float>(xres) * pixel_aspect / static_cast<float>(yres);
}

std::array<float, 4> Options::window() const {
  if (screen_window) return *screen_window;
  float a = aspect();
  if (a >= 1) return {-a, a, -1, 1};
  return {-1, 1, -1 / a, 1 / a};
}

} // namespace render
