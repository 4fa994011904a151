// Textures, environment and shadow maps from images: tiled mip-maps. Functions return "" or why no map was
// made; a file that exists is then as it was.
#pragma once

#include "render/texture/filter_kind.h"
#include "render/texture/wrap.h"

#include <array>
#include <string>

namespace render {

struct MakeSettings {
  TextureWrap swrap = TextureWrap::kBlack, twrap = TextureWrap::kBlack;
  FilterKind filter = FilterKind::kBox; ///< between the levels
  /// In pixels of the image. Wider filters than are usual (widens()) soften the map.
  float swidth = 1, twidth = 1;
};

/// Whether the width of this filter counts at all: of "box", "triangle", "gaussian".
bool has_width(FilterKind filter);
/// Whether a filter of this width is wider than it usually is: a box than 1, the others than 2.
bool widens(FilterKind filter, float width);

std::string make_texture(const std::string& image, const std::string& texture, const MakeSettings&);
/// A texture of heights: the first channel of the image.
std::string make_bump(const std::string& image, const std::string& bump, const MakeSettings&);
std::string make_latlong(const std::string& image, const std::string& texture, const MakeSettings&);
/// Faces px nx py ny pz nz, each seen from the middle of the cube with `fov` degrees. They are put together
/// as one latitude-longitude image, so that there is one way to look up environments, without seams.
std::string make_cube_environment(const std::array<std::string, 6>& faces, const std::string& texture,
                                  float fov, const MakeSettings&);
std::string make_shadow(const std::string& depths, const std::string& shadow);

} // namespace render
