/* translucency.h: surfaces through which things behind are seen blurred.
 *
 * After "Translucency Tricks" (Wooten, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 6).
 */
#ifndef ANEMONE_TRANSLUCENCY_H
#define ANEMONE_TRANSLUCENCY_H

/* Distance to the nearest point of the lattice of equilateral triangles of side 1 that has points at (0, 0) and (1, 0): at most
 * 1/sqrt(3), in the middle of a triangle.
 */
float hexdistance(float x; float y) {
  uniform float rows = sqrt(3);
  float column = mod(x, 1);
  float row = mod(y, rows);
  row = min(row, rows - row); /* the lattice is its own mirror image */
  float left = column * column + row * row;
  float right = left + 1 - 2 * column;
  float dx = column - 0.5, dy = row - 0.5 * rows;
  return sqrt(min(left, right, dx * dx + dy * dy));
}

/* Blobs round the points of a distorted lattice: 1 inside, 0 between them. period is points a unit of x; noise moves the lattice by up to
 * amp, its features noisy a point wide in one direction and var times as narrow in the other.
 */
float frostedblobs(float x; float y; float period; float noisy; float var; float amp; float size; float edge) {
  float px = period * x, py = period * y;
  float mx = 2 * float noise(noisy * px, noisy * var * py) - 1;
  float my = 2 * float noise(noisy * var * px, noisy * py) - 1;
  return 1 - smoothstep(size - edge, size, hexdistance(px + amp * mx, py + amp * my));
}

/* Rays for one point, fewer at points that other rays see: samples times falloff for each ray on the way, one at least. */
float raysat(uniform float samples; uniform float falloff) {
  return max(floor(samples * pow(falloff, raydepth()) + 0.5), 1);
}

/* What is seen from P along a direction of unit length, spread in a cone of this half angle: the mean of what rays see. The farther
 * behind something is, the more it is blurred; a second such surface behind blurs again.
 */
color seenthrough(point P; vector direction; float halfangle; uniform float samples) {
  color sum = 0, seen = 0;
  gather("illuminance", P, direction, halfangle, samples, "surface:Ci", seen) {
    sum += seen;
  }
  return sum / samples;
}

/* The same from a picture of what is behind, made from the same camera: a square of half side rad of the picture. */
color seenbehind(string background; point P; float rad) {
  color behind = 0;
  if (background != "") {
    point place = transform("NDC", P);
    float x = xcomp(place), y = ycomp(place);
    behind = color texture(background, x - rad, y - rad, x + rad, y - rad, x - rad, y + rad, x + rad, y + rad);
  }
  return behind;
}

/* How much of the picture a cone of this half angle covers on what is behind P: rad for seenbehind, of a square that spreads as the cone's
 * disc does. depths is a z picture of what is behind, of the same camera; its depth is averaged over about the blur, or edges of things behind
 * would show.
 */
float radbehind(string depths; point P; float halfangle) {
  point from = transform("camera", P);
  point place = transform("NDC", P);
  float far = float texture(depths, xcomp(place), ycomp(place), "blur", 0.03);
  /* Nothing behind: as if it were far away. */
  float behind = max(far, zcomp(from));
  point at = from * (behind / max(zcomp(from), 1e-6));
  float radius = (behind - zcomp(from)) * tan(halfangle);
  point middle = transform("camera", "NDC", at);
  point side = transform("camera", "NDC", at + vector (radius, 0, 0));
  return sqrt(3) / 2 * abs(xcomp(side) - xcomp(middle));
}

#endif
