/* rmannotes.h: the vocabulary of layered, tiled patterns that Steve May's "RManNotes" taught, as shaders of the time
 * include it. Macros, as they were: they work on floats and colours alike, and rotate2d and topolar2d set their last two
 * arguments.
 */
#ifndef ANEMONE_RMANNOTES_H
#define ANEMONE_RMANNOTES_H

/* ---- Pulses and steps */
#define smoothPulse(a, b, fuzz, x) (smoothstep((a) - (fuzz), (a), (x)) - smoothstep((b) - (fuzz), (b), (x)))
#define pulse(a, b, fuzz, x) smoothPulse(a, b, fuzz, x)
#define boxstep(a, b, x) clamp(((x) - (a)) / ((b) - (a)), 0, 1)

/* ---- Tiles */
#define repeat(x, freq) mod((x) * (freq), 1)
#define whichtile(x, freq) floor((x) * (freq))
#define odd(x) (mod(x, 2) == 1)
#define even(x) (mod(x, 2) == 0)

/* ---- The plane: turned about (ox, oy); to polar coordinates, angles from -PI to PI */
#define rotate2d(x, y, rad, ox, oy, rx, ry) \
  rx = (ox) + cos(rad) * ((x) - (ox)) - sin(rad) * ((y) - (oy)); \
  ry = (oy) + sin(rad) * ((x) - (ox)) + cos(rad) * ((y) - (oy))
#define topolar2d(x, y, r, theta) \
  r = sqrt((x) * (x) + (y) * (y)); \
  theta = atan(y, x)

/* ---- Shapes as values from 0 to 1 */
#define intersection(a, b) ((a) * (b))
#define union(a, b) ((a) + (b) - (a) * (b))
#define difference(a, b) ((a) * (1 - (b)))
#define complement(a) (1 - (a))

/* ---- Layers */
#define blend(a, b, x) mix(a, b, x)
#define lerp(a, b, x) mix(a, b, x)

/* ---- Noise: from -1 to 1; from lo to hi, spread over the range */
#define snoise(x) (2 * noise(x) - 1)
#define snoise2(x, y) (2 * noise(x, y) - 1)
#define udn(x, lo, hi) mix(lo, hi, smoothstep(0.25, 0.75, float noise(x)))
#define udn2(x, y, lo, hi) mix(lo, hi, smoothstep(0.25, 0.75, float noise(x, y)))

/* ---- Filter widths */
#define MINFILTERWIDTH 1e-7
#define filterwidth(x) max(abs(Du(x) * du) + abs(Dv(x) * dv), MINFILTERWIDTH)
#define filterwidth_point(p) max(sqrt(area(p)), MINFILTERWIDTH)

#endif
