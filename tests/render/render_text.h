// Helpers of the renderer's tests: render RIB text with a shading that needs no shaders, look at pixels and
// messages.
#pragma once

#include "render/hider/frame.h"
#include "render/shading/default_surface.h"
#include "render/state/interpreter.h"

#include <string>

namespace render::testing {

/// Ci = Os * Cs, Oi = Os; or, headlight, the default surface. Displaces along N by `displacement`.
class PlainShading : public Shading {
public:
  bool headlight = false;
  float displacement = 0;
  std::unique_ptr<GridShader> make_grid_shader() override;
  slvm::StringPool& strings() override { return strings_; }

private:
  slvm::StringPool strings_;
};

/// What became of a RIB text: the image of its last world block and all messages as printed.
struct Rendered {
  Image image;
  FrameReport report;
  std::string messages;
  Scene scene;

  Color Ci(int x, int y) const;
  float alpha(int x, int y) const { return image.at(Image::kAlpha, x, y); }
  float z(int x, int y) const { return image.at(Image::kZ, x, y); }
  /// Sum of alpha over the image: covered area in pixels.
  double covered() const;
};

/// Of two ways to draw the same: depths differ by rounding, nothing else does.
void expect_alike(const Image& a, const Image& b);

Rendered render_text(const std::string& rib, const FrameSettings& settings = {}, bool headlight = false);
Rendered render_text(const std::string& rib, const FrameSettings& settings, PlainShading& shading);
/// Only the messages.
std::string messages_of(const std::string& rib);

} // namespace render::testing
