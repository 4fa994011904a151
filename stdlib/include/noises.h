/* noises.h: signed, filtered and fractal noise, and cell patterns after Worley.
 *
 * "Filtered" functions take the width over which the result is averaged, usually filterwidth() or filterwidthp() of the
 * argument, and fade to the mean where the noise is finer than that (Apodaca and Gritz, Advanced RenderMan, ch. 12).
 */
#ifndef ANEMONE_NOISES_H
#define ANEMONE_NOISES_H

#include "filterwidth.h"
#include "patterns.h"

/* ---- Noise from -1 to 1. */
float snoise(float x) {
  return 2 * float noise(x) - 1;
}
float snoise(float x; float y) {
  return 2 * float noise(x, y) - 1;
}
float snoise(point p) {
  return 2 * float noise(p) - 1;
}
float snoise(point p; float t) {
  return 2 * float noise(p, t) - 1;
}
float snoisexy(float x; float y) {
  return snoise(x, y);
}
vector vsnoise(float x) {
  return 2 * vector noise(x) - 1;
}
vector vsnoise(float x; float y) {
  return 2 * vector noise(x, y) - 1;
}
vector vsnoise(point p) {
  return 2 * vector noise(p) - 1;
}
vector vsnoise(point p; float t) {
  return 2 * vector noise(p, t) - 1;
}

/* How much of one octave survives a filter of this width; features of noise are about 1 wide. */
float noisefade(float width) {
  return 1 - smoothstep(0.2, 0.75, width);
}
float filteredsnoise(float x; float width) {
  return snoise(x) * noisefade(width);
}
float filteredsnoise(point p; float width) {
  return snoise(p) * noisefade(width);
}
vector filteredvsnoise(float x; float width) {
  return vsnoise(x) * noisefade(width);
}
vector filteredvsnoise(point p; float width) {
  return vsnoise(p) * noisefade(width);
}

/* Noise of a domain that noise distorts (variable lacunarity, after Musgrave). */
float VLNoise(point p; float scale) {
  return snoise(p + scale * vsnoise(p));
}
float filteredVLNoise(point p; float width; float scale) {
  return filteredsnoise(p + scale * filteredvsnoise(p, width), width);
}

/* ---- Sums of octaves: each `lacunarity` times as fine and `gain` times as strong as the one before. `filtwidth` is the
 * filter width of p.
 */
float fBm(point p; float filtwidth; uniform float octaves; uniform float lacunarity; uniform float gain) {
  float sum = 0;
  uniform float octave, frequency = 1, amplitude = 1;
  for (octave = 0; octave < octaves; octave += 1) {
    sum += amplitude * filteredsnoise(frequency * p, frequency * filtwidth);
    frequency *= lacunarity;
    amplitude *= gain;
  }
  return sum;
}
vector vfBm(point p; float filtwidth; uniform float octaves; uniform float lacunarity; uniform float gain) {
  vector sum = 0;
  uniform float octave, frequency = 1, amplitude = 1;
  for (octave = 0; octave < octaves; octave += 1) {
    sum += amplitude * filteredvsnoise(frequency * p, frequency * filtwidth);
    frequency *= lacunarity;
    amplitude *= gain;
  }
  return sum;
}
float VLfBm(point p; float filtwidth; uniform float octaves; uniform float lacunarity; uniform float gain;
            uniform float scale) {
  float sum = 0;
  uniform float octave, frequency = 1, amplitude = 1;
  for (octave = 0; octave < octaves; octave += 1) {
    sum += amplitude * filteredVLNoise(frequency * p, frequency * filtwidth, scale);
    frequency *= lacunarity;
    amplitude *= gain;
  }
  return sum;
}
/* fBm of the absolute value: creases where octaves cross 0. */
float turbulence(point p; float filtwidth; uniform float octaves; uniform float lacunarity; uniform float gain) {
  float sum = 0;
  uniform float octave, frequency = 1, amplitude = 1;
  for (octave = 0; octave < octaves; octave += 1) {
    float width = frequency * filtwidth;
    sum += amplitude * filteredabs(filteredsnoise(frequency * p, width), width);
    frequency *= lacunarity;
    amplitude *= gain;
  }
  return sum;
}

/* With the usual four octaves. Macros, since they take derivatives of the argument as it is written. */
#define fBm_default(p) fBm(p, filterwidthp(p), 4, 2, 0.5)
#define vfBm_default(p) vfBm(p, filterwidthp(p), 4, 2, 0.5)
#define VLfBm_default(p) VLfBm(p, filterwidthp(p), 4, 2, 0.5, 1)
#define turbulence_default(p) turbulence(p, filterwidthp(p), 4, 2, 0.5)

/* ---- Cells (Worley 1996): space is full of feature points, one in each unit cell, moved from its middle by up to
 * jitter/2. f1 is the distance of P to the nearest of them, which is pos1; f2 and pos2 are those of the second nearest.
 */
#define ANEMONE_FAR 1000

void voronoi_f1f2_3d(point P; float jitter; output float f1; output point pos1; output float f2; output point pos2) {
  point middle = point (floor(xcomp(P)), floor(ycomp(P)), floor(zcomp(P))) + vector (0.5, 0.5, 0.5);
  uniform float i, j, k;
  f1 = ANEMONE_FAR;
  f2 = ANEMONE_FAR;
  pos1 = P;
  pos2 = P;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1)
      for (k = -1; k <= 1; k += 1) {
        point cell = middle + vector (i, j, k);
        point feature = cell + jitter * (vector cellnoise(cell) - 0.5);
        float d = distance(feature, P);
        if (d < f1) {
          f2 = f1;
          pos2 = pos1;
          f1 = d;
          pos1 = feature;
        } else if (d < f2) {
          f2 = d;
          pos2 = feature;
        }
      }
}
void voronoi_f1_3d(point P; float jitter; output float f1; output point pos1) {
  float f2;
  point pos2;
  voronoi_f1f2_3d(P, jitter, f1, pos1, f2, pos2);
}

void voronoi_f1f2_2d(float ss; float tt; float jitter; output float f1; output float spos1; output float tpos1;
                     output float f2; output float spos2; output float tpos2) {
  float smiddle = floor(ss) + 0.5, tmiddle = floor(tt) + 0.5;
  uniform float i, j;
  f1 = ANEMONE_FAR;
  f2 = ANEMONE_FAR;
  spos1 = ss;
  tpos1 = tt;
  spos2 = ss;
  tpos2 = tt;
  for (i = -1; i <= 1; i += 1)
    for (j = -1; j <= 1; j += 1) {
      float scell = smiddle + i, tcell = tmiddle + j;
      vector move = jitter * (vector cellnoise(scell, tcell) - 0.5);
      float sfeature = scell + xcomp(move), tfeature = tcell + ycomp(move);
      float d = sqrt((sfeature - ss) * (sfeature - ss) + (tfeature - tt) * (tfeature - tt));
      if (d < f1) {
        f2 = f1;
        spos2 = spos1;
        tpos2 = tpos1;
        f1 = d;
        spos1 = sfeature;
        tpos1 = tfeature;
      } else if (d < f2) {
        f2 = d;
        spos2 = sfeature;
        tpos2 = tfeature;
      }
    }
}
void voronoi_f1_2d(float ss; float tt; float jitter; output float f1; output float spos1; output float tpos1) {
  float f2, spos2, tpos2;
  voronoi_f1f2_2d(ss, tt, jitter, f1, spos1, tpos1, f2, spos2, tpos2);
}

#endif
