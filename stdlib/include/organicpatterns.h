/* organicpatterns.h: a library of patterns chosen by number, for shaders that many models share.
 *
 *     float v = organicpattern(index, q, width, map, ss, tt);
 *
 * index is uniform: only the chosen pattern runs, and a constant index leaves nothing of the others. All results are from 0 to 1. q is the
 * place in pattern space, where features are about 1 wide; width is the filter width of q (filterwidthp(q) of filterwidth.h), over which
 * patterns fade to their mean. Those of the map take it at (ss, tt), such as cubicprojection.h makes.
 *
 *   0 plain         8 domes        16 hexagons     24 granite      32 map
 *   1 noise         9 cups         17 bricks       25 dimples      33 map, noisy
 *   2 fractal      10 stars        18 weave        26 spikes       34 map on cells
 *   3 turbulent    11 stripes      19 checks       27 scales       35 map, warped
 *   4 ridges       12 wood         20 brain        28 fibres
 *   5 spots        13 rings        21 maze         29 speckles
 *   6 crackle      14 dots         22 veins        30 waves
 *   7 patches      15 dots, hex    23 marble       31 pores
 */
#ifndef ANEMONE_ORGANICPATTERNS_H
#define ANEMONE_ORGANICPATTERNS_H

#include "filterwidth.h"
#include "noises.h"
#include "patterns.h"

#define ORGANIC_PATTERNS 36

/* How much of a feature of the given size survives the filter. */
float detail_left(float size; float width) {
  return 1 - smoothstep(0.4 * size, 1.2 * size, width);
}
/* A pattern that the filter cannot hold any more becomes its mean. */
float faded(float value; float mean; float size; float width) {
  return mix(mean, value, detail_left(size, width));
}
/* Noise as a pattern: most of it between 0 and 1. */
float as_pattern(float signed) {
  return clamp(0.5 + 0.5 * signed, 0, 1);
}

/* ---- Noise. */
float pattern_fractal(point q; float width) {
  return as_pattern(fBm(q, width, 4, 2, 0.5));
}
float pattern_turbulent(point q; float width) {
  return faded(min(turbulence(q, min(width, 2), 4, 2, 0.5), 1), 0.42, 1.2, width);
}
float pattern_ridges(point q; float width) {
  float ridge = 1 - min(abs(fBm(q, width, 3, 2.1, 0.5)), 1);
  return faded(ridge * ridge, 0.59, 1, width);
}
float pattern_veins(point q; float width) {
  float near = abs(filteredsnoise(q + 0.6 * filteredvsnoise(1.7 * q, 1.7 * width), width));
  return faded(1 - smoothstep(0, 0.22, near), 0.28, 0.5, width);
}
float pattern_marble(point q; float width) {
  float phase = zcomp(q) * 4 + 5 * turbulence(q, width, 4, 2, 0.5);
  return faded(0.5 + 0.5 * sin(phase), 0.5, 1, width);
}
float pattern_granite(point q; float width) {
  float grain = fBm(3.7 * q, 3.7 * width, 3, 2.3, 0.7);
  return as_pattern(0.6 * grain + 0.4 * filteredsnoise(0.8 * q, 0.8 * width));
}
float pattern_wood(point q; float width) {
  float radius = sqrt(xcomp(q) * xcomp(q) + ycomp(q) * ycomp(q)) + 0.35 * filteredsnoise(0.7 * q, 0.7 * width);
  float ring = mod(radius, 1);
  return faded(smoothstep(0, 0.8, ring) - smoothstep(0.83, 1, ring), 0.5, 0.5, width);
}
float pattern_fibres(point q; float width) {
  point along = point (6 * xcomp(q), 6 * ycomp(q), 0.5 * zcomp(q));
  return as_pattern(fBm(along, 6 * width, 2, 2, 0.5));
}
float pattern_brain(point q; float width) {
  vector move = 1.1 * filteredvsnoise(0.55 * q, 0.55 * width);
  point w = q + move;
  float groove = abs(sin(PI * (xcomp(w) + 0.5 * ycomp(w) + 0.6 * zcomp(w)) + 3 * filteredsnoise(1.1 * w, 1.1 * width)));
  return faded(sqrt(groove), 0.76, 0.5, width);
}
float pattern_maze(point q; float width) {
  float a = filteredsnoise(1.3 * q, 1.3 * width), b = filteredsnoise(1.3 * q + vector (17.3, 5.1, 9.7), 1.3 * width);
  float soft = 0.08 + width;
  return faded(smoothstep(-soft, soft, a * b * 4), 0.5, 0.7, width);
}
float pattern_waves(point q; float width) {
  float w = sin(4 * xcomp(q) + 2 * sin(1.3 * ycomp(q))) + sin(3.1 * ycomp(q) + 1.7 * sin(1.9 * zcomp(q))) +
            sin(3.7 * zcomp(q) + 2.3 * sin(1.1 * xcomp(q)));
  return faded(as_pattern(w / 3), 0.5, 1, width);
}

/* ---- Cells: all by one search for the two nearest feature points. kind is that of organicpattern. */
float pattern_cells(uniform float kind; point q; float width) {
  float f1, f2;
  point nearest, second;
  voronoi_f1f2_3d(q, 0.8, f1, nearest, f2, second);
  float chance = cellnoise(nearest);
  float value, mean, size = 1;
  if (kind == 5) {          /* spots of several sizes */
    float radius = 0.22 + 0.2 * chance;
    value = 1 - smoothstep(radius - 0.05 - width, radius + 0.05 + width, f1);
    mean = 0.15;
  } else if (kind == 6) {   /* crackle: the borders of cells */
    value = 1 - smoothstep(0.02, 0.12 + width, f2 - f1);
    mean = 0.25;
    size = 0.5;
  } else if (kind == 7) {   /* patches of one value each */
    value = chance;
    mean = 0.5;
  } else if (kind == 8) {   /* domes: half spheres that meet */
    float x = min(f1 / 0.55, 1);
    value = sqrt(1 - x * x);
    mean = 0.36;
  } else if (kind == 9) {   /* cups: a rim round a pit */
    float x = f1 / 0.55;
    value = smoothstep(0.12, 0.62, x) * (1 - smoothstep(0.68, 1, x));
    mean = 0.34;
  } else if (kind == 10) {  /* stars: ridges that run from the middle of each dome */
    vector d = q - nearest;
    float angle = atan(ycomp(d) + zcomp(d), xcomp(d) - 0.3 * zcomp(d));
    float x = min(f1 / 0.55, 1);
    value = sqrt(1 - x) * (0.6 + 0.4 * cos(6 * angle + 2 * PI * chance));
    mean = 0.17;
    size = 0.5;
  } else if (kind == 25) {  /* dimples: domes turned inside out */
    float x = min(f1 / 0.5, 1);
    value = 1 - 0.9 * (1 - x * x) * (1 - x * x);
    mean = 0.9;
  } else if (kind == 26) {  /* spikes */
    float x = max(1 - f1 / 0.5, 0);
    value = x * x * x;
    mean = 0.03;
    size = 0.6;
  } else if (kind == 29) {  /* speckles: few, small and sharp */
    float soft = 0.03 + width;
    value = chance > 0.3 ? 1 - smoothstep(0.16 - soft, 0.16 + soft, f1) : 0;
    mean = 0.013;
    size = 0.4;
  } else {                  /* pores: small pits in a rough surface */
    value = as_pattern(0.5 + 0.3 * filteredsnoise(2 * q, 2 * width)) * smoothstep(0.08, 0.3, f1);
    mean = 0.72;
    size = 0.6;
  }
  return faded(value, mean, size, width);
}

/* ---- Tilings of a plane; a and b are places in it. */
float pattern_disc(float a; float b; float radius; float width) {
  float soft = 0.06 + width;
  return 1 - smoothstep(radius - soft, radius + soft, sqrt(a * a + b * b));
}
float pattern_tiled(uniform float kind; float a; float b; float width) {
  float value, mean = 0.5, size = 0.5;
  if (kind == 11) {         /* stripes */
    value = filteredsmoothpulse(0.15, 0.35, 0.65, 0.85, mod(a, 1), width);
  } else if (kind == 13) {  /* rings about the origin */
    value = 0.5 + 0.5 * cos(2 * PI * sqrt(a * a + b * b));
  } else if (kind == 14) {  /* dots in rows */
    value = pattern_disc(mod(a, 1) - 0.5, mod(b, 1) - 0.5, 0.3, width);
    mean = 0.28;
  } else if (kind == 15 || kind == 16) { /* the nearest of a triangular lattice: dots, or hexagons with a groove */
    float row = floor(b / 0.8660254 + 0.5);
    float best = 4, other = 4;
    uniform float k;
    for (k = -1; k <= 1; k += 1) {
      float r = row + k, shift = 0.5 * mod(r, 2);
      float column = floor(a - shift + 0.5);
      float left = column + (a - shift < column ? -1 : 1);
      float db = b - 0.8660254 * r, da = a - shift - column, dl = a - shift - left;
      float d = da * da + db * db, e = dl * dl + db * db;
      other = min(other, max(best, d), e);
      best = min(best, d);
    }
    if (kind == 15) {
      value = 1 - smoothstep(0.27 - width, 0.33 + width, sqrt(best));
      mean = 0.33;
    } else {
      value = smoothstep(0.02, 0.14 + width, (other - best) / 2);
      mean = 0.69;
    }
  } else if (kind == 17) {  /* bricks */
    float column, row, across, along;
    basicbrick(a, b, 1, 0.5, 0.5, 0, 0, 0, column, row, across, along);
    value = min(filteredsmoothstep(0, 0.12, min(across, 1 - across), width),
                filteredsmoothstep(0, 0.24, min(along, 1 - along), width));
    mean = 0.67;
  } else if (kind == 18) {  /* weave: over and under */
    float over = mod(floor(a) + floor(b), 2);
    float x = over == 0 ? mod(a, 1) : mod(b, 1);
    value = sin(PI * x);
    mean = 0.64;
  } else if (kind == 19) {  /* checks */
    value = mod(floor(a) + floor(b), 2);
    size = 1;
  } else {                  /* scales: rows of discs, each over the one behind */
    float row = floor(b), found = 0;
    uniform float k;
    value = 0;
    for (k = 0; k <= 1; k += 1) {
      float r = row + k, shift = 0.5 * mod(r, 2);
      float da = mod(a - shift, 1) - 0.5, db = b - r;
      float d = sqrt(da * da + db * db) / 0.62;
      if (found == 0 && d < 1) {
        value = 1 - 0.8 * d * d;
        found = 1;
      }
    }
    mean = 0.66;
  }
  return faded(value, mean, size, width);
}

/* ---- All of them. */
float organicpattern(uniform float index; point q; float width; string map; float ss; float tt) {
  float value = 0.5;
  if (index == 1)
    value = as_pattern(filteredsnoise(q, width));
  else if (index == 2)
    value = pattern_fractal(q, width);
  else if (index == 3)
    value = pattern_turbulent(q, width);
  else if (index == 4)
    value = pattern_ridges(q, width);
  else if ((index >= 5 && index <= 10) || index == 25 || index == 26 || index == 29 || index == 31)
    value = pattern_cells(index, q, width);
  else if (index == 12)
    value = pattern_wood(q, width);
  else if (index == 11 || (index >= 13 && index <= 19) || index == 27)
    value = pattern_tiled(index, ss, tt, width);
  else if (index == 20)
    value = pattern_brain(q, width);
  else if (index == 21)
    value = pattern_maze(q, width);
  else if (index == 22)
    value = pattern_veins(q, width);
  else if (index == 23)
    value = pattern_marble(q, width);
  else if (index == 24)
    value = pattern_granite(q, width);
  else if (index == 28)
    value = pattern_fibres(q, width);
  else if (index == 30)
    value = pattern_waves(q, width);
  else if (index >= 32 && map != "") {
    if (index == 33)
      value = float texture(map, ss, tt) * (0.6 + 0.8 * as_pattern(filteredsnoise(q, width)));
    else if (index == 34)
      value = max(float texture(map, ss, tt), pattern_cells(8, q, width));
    else if (index == 35) {
      vector move = 0.15 * filteredvsnoise(q, width);
      value = float texture(map, ss + xcomp(move), tt + ycomp(move));
    } else
      value = float texture(map, ss, tt);
  }
  return clamp(value, 0, 1);
}

#endif
