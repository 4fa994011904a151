/* skin.h: what skin has besides light below its surface: pores and creases in relief, and an oily coat that mirrors.
 *
 * All formulas but that of the coat are of this project; numbers are those of a face.
 */
#ifndef ANEMONE_SKIN_H
#define ANEMONE_SKIN_H

#include "filterwidth.h"
#include "noises.h"

/* Heights of the skin, 0 on the flat of it and down to -1 in its creases. q: where, in a space that stands still on the skin, in cells; cells
 * are about 1 wide and creases meet where three of them do. What is finer than width, a length in the space of q, is left out.
 */
float skinrelief(point q; float width) {
  float f1, f2;
  point pos1, pos2;
  /* Cells are drawn out here and there, as skin is where it folds. */
  point drawn = q + 0.35 * filteredvsnoise(0.7 * q, 0.7 * width);
  voronoi_f1f2_3d(drawn, 0.9, f1, pos1, f2, pos2);
  float crease = 1 - smoothstep(0, 0.3, f2 - f1);
  float seen = 1 - smoothstep(0.25, 0.8, width);
  return -seen * crease * (0.55 + 0.45 * noise(0.45 * q));
}

/* The normal, of unit length, of the surface at P moved by height (a length in "current" space) along the normal Nn: a bump. smooth is the
 * normal that the renderer gives, Ng that of the facets; their difference is kept, so that meshes stay smooth.
 */
normal bumped(point P; normal Nn; normal Ng; float height) {
  normal moved = normalize(calculatenormal(P + height * Nn));
  return normalize(Nn + (moved - normalize(Ng)));
}

/* Part of the light that a thin coat sends from L to V, both of unit length, times the cosine at the light and PI, as specular()'s parts are:
 * Fresnel's term of the half direction, and slopes as Beckmann has them, m their root mean square: 0.05 wet, 0.2 oily, 0.4 dry. Kelemen and
 * Szirmay-Kalos 2001, whose geometry term is 1 over the square of L + V.
 */
float coatlobe(vector L; normal Nn; vector V; float eta; float m) {
  vector sum = L + V;
  float cosine = max(normalize(sum) . Nn, 1e-3), light = L . Nn, part = 0;
  if (light > 0 && V . Nn > 0) {
    float kr, kt;
    fresnel(-V, normal normalize(sum), 1 / eta, kr, kt);
    float squared = cosine * cosine;
    float slopes = exp((1 - 1 / squared) / (m * m)) / (PI * m * m * squared * squared);
    part = PI * light * slopes * kr / (sum . sum);
  }
  return part;
}

/* The mirrored light of all lights, of two layers of slopes: a smooth oily one, and the rough skin below it with the rest of the weight. */
color skincoat(point P; normal Nn; vector V; float eta; float oily; float rough; float oiliness) {
  color sum = 0;
  illuminance(P, Nn, PI / 2) {
    uniform float nonspecular = 0;
    lightsource("__nonspecular", nonspecular);
    if (nonspecular < 1) {
      vector Ln = normalize(L);
      sum += (1 - nonspecular) * Cl * mix(coatlobe(Ln, Nn, V, eta, rough), coatlobe(Ln, Nn, V, eta, oily), oiliness);
    }
  }
  return sum;
}

#endif
