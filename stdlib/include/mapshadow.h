/* mapshadow.h: shadows by maps, for light shaders: filtered over a piece of surface whose size is known from elsewhere, and maps that say
 * where rays are needed.
 */
#ifndef ANEMONE_MAPSHADOW_H
#define ANEMONE_MAPSHADOW_H

/* 0 lit to 1 in shadow: over a square of this side (a length in "current" space) round Ps, across the light's direction L. blur: as for
 * shadow(), a part of the map.
 */
float shadowover(uniform string map; point Ps; vector L; float side; float blur) {
  vector along = normalize(L);
  vector a = 0.5 * side * normalize(along ^ (abs(xcomp(along)) > 0.7 ? vector (0, 1, 0) : vector (1, 0, 0)));
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

#endif
