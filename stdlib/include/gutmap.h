/* gutmap.h: what is inside a thin translucent body, from a map that the viewing camera made of its inside alone.
 *
 * After "Shading Fish Guts" (Bashforth, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 7). The map has one channel for each
 * thing that is told apart, 1 where it is seen. It is projected through NDC, so that the inside moves against the surface as it should,
 * and blurred as if seen through flesh.
 */
#ifndef ANEMONE_GUTMAP_H
#define ANEMONE_GUTMAP_H

/* Where P is in the map, 0 to 1 across and down. */
void gutplace(point P; output float ss; output float tt) {
  point place = transform("NDC", P);
  ss = xcomp(place);
  tt = ycomp(place);
}

/* How much of the map a length in shader space covers at P, seen from the camera: the blur that stays the same on the body at
 * every distance. A direction across the view is taken to shader space, given the length there, and laid on the map. (The course
 * transforms it as a vector, for which perspective has no distance; the difference of two points has.)
 */
float gutblur(point P; float amount) {
  vector across = normalize(vtransform("current", "shader", vector "camera" (1, 1, 0)));
  point from = transform("NDC", P);
  point to = transform("NDC", P + vtransform("shader", "current", across * amount));
  vector move = to - from;
  return sqrt(xcomp(move) * xcomp(move) + ycomp(move) * ycomp(move));
}

/* 1 when a body that is thin in x of shader space is seen from its flat side, down to 0 when it is seen edge on: the cosine between the
 * thin axis and the view. (The course takes x times y of a turned (0, 1, 1), which is the same for a body that swims level, and 0 also for
 * the flat side of one that swims steeply.)
 */
float flatside() {
  return abs(zcomp(normalize(vtransform("shader", "camera", vector (1, 0, 0)))));
}

/* The same blur for a body that is thin: thin times as large when seen edge on. */
float thinblur(float blur; float thin) {
  return mix(blur * thin, blur, flatside());
}

/* One channel of the map. mipmapped 0 filters the map itself whatever the blur, which a small map can afford: the lower levels of a mip-map
 * are averages of squares, and large blurs show them.
 */
float gutmap(string map; uniform float channel; float ss; float tt; float blur; uniform float mipmapped) {
  float sum = 0;
  if (map != "") {
    if (mipmapped != 0)
      sum = float texture(map[channel], ss, tt, "blur", blur);
    else {
      /* A disc of samples, each weighted by a Gaussian that is small at its rim: no square shows. */
      float total = 0;
      uniform float ring, spoke;
      for (ring = 0; ring < 6; ring += 1)
        for (spoke = 0; spoke < 12; spoke += 1) {
          uniform float r = (ring + 0.5) / 6, angle = (spoke + 0.5 * mod(ring, 2)) * PI / 6;
          uniform float weight = r * exp(-2 * r * r);
          float x = ss + 0.5 * blur * r * cos(angle), y = tt + 0.5 * blur * r * sin(angle);
          sum += weight * float texture(map[channel], x, y, x, y, x, y, x, y, "lerp", 0);
          total += weight;
        }
      sum /= total;
    }
  }
  return sum;
}

#endif
