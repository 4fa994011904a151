/* filterwidth.h: how much of a pattern one shading element covers. Patterns that are averaged over that width, or fade
 * out before their features get smaller than it, do not alias.
 */
#ifndef ANEMONE_FILTERWIDTH_H
#define ANEMONE_FILTERWIDTH_H

/* Widths are never 0, so that one can divide by them. */
#define MINFILTWIDTH 1.0e-6

/* Change of x over the element: |dx/du| du + |dx/dv| dv. */
float filterwidth(float x) {
  extern float du, dv;
  return max(abs(Du(x) * du) + abs(Dv(x) * dv), MINFILTWIDTH);
}

/* Side of the element in the space of p: root of the area that p sweeps. */
float filterwidthp(point p) {
  return max(sqrt(area(p)), MINFILTWIDTH);
}

/* g as long as its features are larger than the filter, g_avg when they are lost in it. */
float fadeout(float g; float g_avg; float featuresize; float fwidth) {
  return mix(g, g_avg, smoothstep(0.2, 0.6, fwidth / featuresize));
}
color fadeout(color g; color g_avg; float featuresize; float fwidth) {
  return mix(g, g_avg, smoothstep(0.2, 0.6, fwidth / featuresize));
}

#endif
