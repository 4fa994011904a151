/* facepaint.sl: the colours of the goblin of head.py under diffuse light, seen from in front: s and t are those of its skin. */
#include "noises.h"

/* 1 in the middle of an ellipse round (cx, cy), 0 outside, soft. Both sides of the face. */
float dab(float x; float y; float cx; float cy; float rx; float ry) {
  float u = (abs(x) - cx) / rx, v = (y - cy) / ry;
  return 1 - smoothstep(0.25, 1, sqrt(u * u + v * v));
}

/* How near a point is to one of the veins of an ear: noise about 0, in lines drawn out along them. */
float veins(point q; float wide) {
  return 1 - smoothstep(0, wide, abs(filteredsnoise(q, 0.02)));
}

surface
facepaint(uniform color skin = color (0.63, 0.41, 0.29), blood = color (0.55, 0.15, 0.11), pale = color (0.7, 0.52, 0.36),
                        brown = color (0.26, 0.14, 0.08);)
{
  float x = 2 * s - 1, y = 1.05 - 1.5 * t;
  point q = point (x, y, 0.5);
  color c = mix(skin, pale, 0.7 * dab(x, y, 0, 0.82, 0.42, 0.3));
  /* Blotches large and small. */
  c *= 1 + 0.22 * fBm(7 * q, 0.01, 4, 2, 0.55);
  c = mix(c, blood, 0.22 * smoothstep(0.05, 0.5, fBm(11 * q + vector (3, 1, 7), 0.01, 3, 2, 0.5)));
  /* Where blood is near: nose, cheeks, lips, rims of the eyes, ears. */
  float red = 0.6 * dab(x, y, 0, 0.33, 0.1, 0.08);
  red = max(red, 0.42 * dab(x, y, 0.2, 0.33, 0.14, 0.12));
  red = max(red, 0.4 * dab(x, y, 0.15, 0.465, 0.135, 0.085));
  red = max(red, 0.3 * dab(x, y, 0, 0.07, 0.12, 0.08));
  red = max(red, 0.4 * smoothstep(0.38, 0.62, abs(x)) * smoothstep(0.12, 0.2, y));
  float ear = smoothstep(0.3, 0.4, abs(x)) * smoothstep(0.15, 0.25, y), up = y - 0.4 * abs(x);
  red = max(red, 0.75 * ear * max(veins(point (5 * abs(x), 11 * up, 2), 0.09), 0.7 * veins(point (9 * abs(x), 19 * up, 5), 0.1)));
  c = mix(c, blood * (0.9 + 0.3 * noise(40 * q)), red);
  float u = abs(x) / 0.155;
  float lips = (1 - smoothstep(0.8, 1, u)) * smoothstep(0.142 + 0.03 * u * u, 0.155 + 0.04 * u * u, y) * (1 - smoothstep(0.228, 0.242, y));
  c = mix(c, color (0.5, 0.17, 0.14) * (0.85 + 0.35 * noise(point (90 * x, 12 * y, 1))), 0.75 * lips);
  /* Freckles, and hairs of the brows. */
  float f1;
  point at;
  voronoi_f1_3d(30 * q, 0.9, f1, at);
  float freckled = max(dab(x, y, 0.1, 0.38, 0.26, 0.13), 0.55 * dab(x, y, 0, 0.85, 0.5, 0.25));
  float freckle = (1 - smoothstep(0.1, 0.24, f1)) * step(0.62, float cellnoise(at)) * freckled;
  c = mix(c, brown, 0.5 * freckle);
  float along = (abs(x) - 0.05) / 0.2;
  float brow = smoothstep(0, 0.15, along) * (1 - smoothstep(0.8, 1, along));
  float middle = 0.583 + 0.035 * sin(PI * clamp(along, 0, 1) * 0.8), half = 0.024 * (1 - 0.6 * along);
  brow *= 1 - smoothstep(0.4 * half, half, abs(y - middle));
  brow *= smoothstep(0.32, 0.6, noise(point (150 * abs(x) - 130 * y, 25 * y, 3)));
  c = mix(c, brown * 0.4, 0.8 * brow);
  Oi = 1;
  Ci = c;
}
