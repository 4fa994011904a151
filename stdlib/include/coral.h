/* coral.h: what the coral shaders are made of: variation of models, placement of layers, and light that seems to come from within.
 *
 * After "Shading a Coral Reef" (Bernardi, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9).
 *
 * Scalar fields are primitive variables, 0 to 1: basedistance is 0 at the base of a model, tipdistance 0 at its tips, each 1 at the
 * farthest vertex. One need not be 1 minus the other: branches differ in length.
 */
#ifndef ANEMONE_CORAL_H
#define ANEMONE_CORAL_H

#include "organicpatterns.h"
#include "cubicprojection.h"
#include "transitions.h"

/* ---- Variation: three random numbers from -0.5 to 0.5 for a model, by its number; 0 for number 0, the model as it is. */
vector modelvariation(uniform float id) {
  return id == 0 ? vector 0 : vector cellnoise(id + 0.5) - vector (0.5, 0.5, 0.5);
}

/* A colour moved in hue by up to hue/2 of the circle, in saturation and value by up to that part of themselves. */
color variedcolor(color c; vector variation; float hue; float saturation; float value) {
  color hsv = ctransform("rgb", "hsv", c);
  float h = mod(comp(hsv, 0) + hue * xcomp(variation), 1);
  float s = clamp(comp(hsv, 1) * (1 + 2 * saturation * ycomp(variation)), 0, 1);
  float v = comp(hsv, 2) * (1 + 2 * value * zcomp(variation));
  return ctransform("hsv", "rgb", color (h, s, v));
}

/* Pattern space of a model: a number for size as well as for place. */
point variedspace(point p; vector variation; float size; float sizevariation) {
  return p / (size * (1 + sizevariation * ycomp(variation))) + 61.7 * variation;
}

/* ---- Polyps: the height of one pattern after processing. low and high choose the part of the pattern that counts, gain below 1
 * sharpens and above 1 fattens, suppress takes polyps away where the mask is 0.
 */
float polypheight(float pattern; float low; float high; float gain; float suppress) {
  float h = clamp((pattern - low) / max(high - low, 1e-4), 0, 1);
  return pow(h, 1 / max(gain, 1e-3)) * suppress;
}

/* ---- Light from within. Every light counts in full at every point, whatever the normal; what makes it a look is multiplied later.
 *
 * forward, 0 to 1, is how much it matters that a light is behind the model: its share grows from 0, when it shines the way the
 * camera looks, to 1, when it shines into the camera. density, 0 to 1, is how much of a shadow is seen in it. Lights whose
 * parameter __scatter is not 1 count for that part.
 */
color scatterillum(point at; vector I; float forward; float density) {
  color sum = 0;
  vector into = normalize(I);
  illuminance (at, "send:light:__shadowdensity", density) {
    float part = 1;
    lightsource("__scatter", part);
    float behind = smoothstep(-1, 1, normalize(L) . into);
    sum += part * mix(1, behind, forward) * Cl;
  }
  return sum;
}

/* The colour of scattered light: inner at the edges of the model, where normaldot (the normal towards the viewer, before any displacement)
 * is 0, or near its tips; outer where there is more of it to go through. texcolor takes over as density, a blurred pattern, says.
 */
color scattercolor(color inner; color outer; color texcolor; float tipdistance; float normaldot; float density) {
  return mix(mix(inner, outer, tipdistance * normaldot), texcolor, density);
}

/* How much a unit normal faces the viewer, either side. */
float facing(normal n; vector I) {
  return abs(n . normalize(I));
}

#endif
