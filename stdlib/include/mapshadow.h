/* mapshadow.h: shadows by maps, for light shaders: filtered over a piece of surface whose size is known from elsewhere, and maps that say
 * where rays are needed.
 */
#ifndef ANEMONE_MAPSHADOW_H
#define ANEMONE_MAPSHADOW_H

#include "axisacross.h"

/* 0 lit to 1 in shadow: over a square of this side (a length in "current" space) round Ps, across the light's direction L. blur: as for
 * shadow(), a part of the map.
 */
float shadowover(uniform string map; point Ps; vector L; float side; float blur) {
  vector along = normalize(L);
  vector a = 0.5 * side * axisacross(along);
  vector b = along ^ a;
  return shadow(map, Ps - a - b, Ps + a - b, Ps - a + b, Ps + a + b, "blur", blur);
}

/* The shadow of one map at Ps. A surface that lights samples from anywhere, as scattermap() does, says so by its variable __overrideDerivs (not
 * 0), and how large each is by __derivA, an area in "current" space: the neighbours of Ps say nothing then. Both are asked by surface().
 */
float mapshadow(uniform string map; point Ps; vector L; float blur) {
  float override = 0, area = 0, dark = 0;
  surface("__overrideDerivs", override);
  surface("__derivA", area);
  if (override != 0)
    dark = shadowover(map, Ps, L, sqrt(max(area, 0)), blur);
  else
    dark = shadow(map, Ps, "blur", blur);
  return dark;
}

/* What a low shadow map is sure of: 0 where all of the surface within radius of Ps ("current" space) is lit, 1 where all of it is in shadow, and
 * -1 in the grey zone between, where rays have to tell. Places are looked up in the tangent plane, each with its own depth, or surfaces that
 * slant away from the light would shadow themselves. radius has to be wide enough for the map's pixels and for the penumbra; bias, a depth, for
 * how much deeper a surface is at the other side of a pixel.
 */
float suremapshadow(uniform string map; point Ps; normal Ns; float radius; float bias) {
  vector n = normalize(Ns), a = axisacross(n), b = n ^ a;
  float sum = shadow(map, Ps, "width", 0, "bias", bias);
  uniform float places = 18, i;
  for (i = 0; i < places; i += 1) {
    /* The outer ones of a spiral of golden angles lie on the rim. */
    uniform float r = sqrt(min((i + 1) / (places - 5), 1)), angle = 2.3999632 * i;
    sum += shadow(map, Ps + radius * r * (cos(angle) * a + sin(angle) * b), "width", 0, "bias", bias);
  }
  return sum <= 0 ? 0 : sum >= places + 1 ? 1 : -1;
}

#endif
