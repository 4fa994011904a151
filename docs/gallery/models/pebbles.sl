/* pebbles.sl: gravel: stones of several colours. With coraldisplacement.sl of the same size, whose pattern 8 gives them their form. */
#include "noises.h"

surface
pebbles(uniform float size = 0.05;                  /* of a stone, shader space */
        uniform color one = color (0.55, 0.45, 0.32), other = color (0.25, 0.17, 0.1), odd = color (0.75, 0.72, 0.66);
        )
{
  point before = P, nearest, second;
  float f1, f2, height = 1;
  displacement("undisplaced", before);
  displacement("polyp", height);
  voronoi_f1f2_3d(transform("shader", before) / size, 0.8, f1, nearest, f2, second);
  float chance = cellnoise(nearest);
  color C = chance > 0.86 ? odd : mix(one, other, chance);
  normal Nf = faceforward(normalize(N), I);
  Oi = 1;
  /* Little light gets between the stones. */
  Ci = Cs * C * (0.35 + 0.65 * smoothstep(0, 0.5, height)) * (ambient() + diffuse(Nf));
}
