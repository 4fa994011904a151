/* normals.h: the normal that shading wants.
 */
#ifndef ANEMONE_NORMALS_H
#define ANEMONE_NORMALS_H

/* N at unit length, turned to the viewer where both sides of the surface are seen: on two-sided surfaces, and for all
 * rays that do not come from the camera.
 */
normal shadingnormal(normal N) {
  extern vector I;
  normal Nn = normalize(N);
  uniform float sides = 2;
  attribute("Sides", sides);
  if (sides == 2 || raydepth() > 0)
    Nn = faceforward(Nn, I, Nn);
  return Nn;
}

#endif
