// Directions as places of latitude-longitude maps.
#pragma once

#include "render/texture/texture_filter.h"

namespace render {

/// Directions of any length, z up, and how they change along the two sides of a region; many at a time, by
/// component.
struct Directions {
  using Lanes = TextureRegions::Lanes;

  alignas(64) Lanes centre[3] = {}, along_u[3] = {}, along_v[3] = {};
};

/// s = longitude / 2 PI, t = (PI / 2 - latitude) / PI. The blur along s, as it was at the equator, becomes
/// that of the same angle at the latitude: at the poles, of all longitudes.
void find_latlong(const Directions& directions, TextureRegions& out);

} // namespace render
