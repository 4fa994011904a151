/* paving.sl: slabs of stone, matte, with narrow joints; both fade to their mean where they are too small to be seen. */
#include "filterwidth.h"
#include "patterns.h"

/* The part of a joint of this half width round whole numbers that a filter at x sees. */
float jointpart(float x; float half) {
  float width = max(filterwidth(x), 1e-4);
  return 1 - filteredpulsetrain(2 * half, 1, x + half, width);
}

surface
paving(uniform float slab = 0.62, joint = 0.012;)
{
  point q = transform("world", P);
  float x = xcomp(q) / slab, z = zcomp(q) / slab;
  float near = 1 - smoothstep(0.3, 1, filterwidth(z) + filterwidth(x));
  float row = floor(z), shifted = x + 0.5 * mod(row, 2);
  float gap = max(jointpart(z, joint / slab), jointpart(shifted, joint / slab));
  float tone = 0.87 + near * (0.18 * (float cellnoise(floor(shifted), row) - 0.5) - 0.1 * (float noise(14 * q) - 0.5));
  normal Nf = faceforward(normalize(N), I);
  Oi = 1;
  Ci = Cs * tone * (1 - 0.7 * gap) * (ambient() + diffuse(Nf));
}
