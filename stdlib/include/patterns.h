/* patterns.h: pulses, pulse trains and tilings; each also averaged over a filter width.
 *
 * A filtered function is the mean of the plain one over [x - dx/2, x + dx/2]: the difference of the integral at both
 * ends, divided by dx (Apodaca and Gritz, Advanced RenderMan, 11.3).
 */
#ifndef ANEMONE_PATTERNS_H
#define ANEMONE_PATTERNS_H

#include "filterwidth.h"

float sqr(float x) {
  return x * x;
}

/* Mean of abs(x). */
float filteredabs(float x; float dx) {
  float low = x - 0.5 * dx, high = x + 0.5 * dx;
  return dx > 0 ? 0.5 * (high * abs(high) - low * abs(low)) / dx : abs(x);
}

/* Integral of 3y^2 - 2y^3 from 0, clamped as smoothstep is. */
float smoothstepintegral(float y) {
  float inside = clamp(y, 0, 1);
  return inside * inside * inside * (1 - 0.5 * inside) + max(y - 1, 0);
}
/* Mean of smoothstep(e0, e1, x). */
float filteredsmoothstep(float e0; float e1; float x; float dx) {
  float y = (x - e0) / (e1 - e0), half_width = 0.5 * dx / (e1 - e0);
  float mean = (smoothstepintegral(y + half_width) - smoothstepintegral(y - half_width)) / (2 * half_width);
  return abs(half_width) > 1e-4 ? mean : smoothstep(e0, e1, x);
}

/* 1 from edge0 to edge1, else 0. */
float pulse(float edge0; float edge1; float x) {
  return step(edge0, x) - step(edge1, x);
}
float filteredpulse(float edge0; float edge1; float x; float dx) {
  float low = x - 0.5 * dx, high = x + 0.5 * dx;
  return dx > 0 ? max(min(high, edge1) - max(low, edge0), 0) / dx : pulse(edge0, edge1, x);
}

/* In each period: 0 before edge, 1 from there to its end. */
float pulsetrain(float edge; float period; float x) {
  return step(edge, mod(x, period));
}
/* Integral of the train of period 1 from 0 to t. */
float pulsetrainintegral(float edge; float t) {
  float periods = floor(t);
  return (1 - edge) * periods + max(t - periods - edge, 0);
}
float filteredpulsetrain(float edge; float period; float x; float dx) {
  float start = edge / period, middle = x / period, width = dx / period;
  float mean = (pulsetrainintegral(start, middle + 0.5 * width) - pulsetrainintegral(start, middle - 0.5 * width)) / width;
  return width > 1e-5 ? mean : pulsetrain(edge, period, x);
}

/* Rises from e0 to e1, falls from e2 to e3. */
float smoothpulse(float e0; float e1; float e2; float e3; float x) {
  return smoothstep(e0, e1, x) - smoothstep(e2, e3, x);
}
float filteredsmoothpulse(float e0; float e1; float e2; float e3; float x; float dx) {
  return filteredsmoothstep(e0, e1, x, dx) - filteredsmoothstep(e2, e3, x, dx);
}
float smoothpulsetrain(float e0; float e1; float e2; float e3; float period; float x) {
  return smoothpulse(e0, e1, e2, e3, mod(x, period));
}

/* A colour that differs from Cin by up to the given parts of hue, saturation and luminance, the same for one index. */
color varyEach(color Cin; float index; float varyhue; float varysat; float varylum) {
  color hsl = ctransform("hsl", Cin);
  vector chance = vector cellnoise(index, 0.5) - 0.5;
  float hue = mod(comp(hsl, 0) + varyhue * xcomp(chance), 1);
  float saturation = clamp(comp(hsl, 1) * (1 + varysat * ycomp(chance)), 0, 1);
  float luminance = clamp(comp(hsl, 2) * (1 + varylum * zcomp(chance)), 0, 1);
  return ctransform("hsl", "rgb", color (hue, saturation, luminance));
}

/* Unit tiles with grooves between them: 1 on a tile, 0 in a groove, filtered over ds and dt. Also which tile this is,
 * and where on it.
 */
float tilepattern(float ss; float tt; float ds; float dt; float groovewidth; float grooveheight;
                  output float swhichtile; output float twhichtile; output float stile; output float ttile) {
  swhichtile = floor(ss);
  twhichtile = floor(tt);
  stile = ss - swhichtile;
  ttile = tt - twhichtile;
  float across = filteredpulsetrain(groovewidth, 1, ss + 0.5 * groovewidth, ds);
  float along = filteredpulsetrain(grooveheight, 1, tt + 0.5 * grooveheight, dt);
  return across * along;
}

/* Bricks in rows, each row shifted against the one below by rowstagger and a random part of rowstaggervary. jaggedamp
 * and jaggedfreq make edges uneven. column and row tell the brick, xtile and ytile the place on it, 0 to 1.
 */
void basicbrick(float x; float y; uniform float tilewidth; uniform float tileheight; uniform float rowstagger;
                uniform float rowstaggervary; uniform float jaggedfreq; uniform float jaggedamp;
                output float column; output float row; output float xtile; output float ytile) {
  float across = x / tilewidth, along = y / tileheight;
  if (jaggedamp != 0) {
    vector move = jaggedamp * vector noise(across * jaggedfreq, along * jaggedfreq);
    across += xcomp(move) / tilewidth;
    along += ycomp(move) / tileheight;
  }
  row = floor(along);
  across += mod(rowstagger * row, 1) + rowstaggervary * (float noise(row + 0.5) - 0.5);
  column = floor(across);
  xtile = across - column;
  ytile = along - row;
}

#endif
