/* planks.sl: varnished boards that run along x of world space, with grain; they fade to their mean where they are too small to be seen. */
#include "filterwidth.h"
#include "noises.h"

surface
planks(uniform float width = 0.32, joint = 0.008;       /* of a board; of the gap between two */
       uniform color dark = color (0.22, 0.1, 0.045), light = color (0.5, 0.27, 0.12);
       uniform float Ka = 1, Kd = 0.9, Ks = 0.12, roughness = 0.15;
       )
{
  point q = transform("world", P);
  float board = floor(zcomp(q) / width), across = mod(zcomp(q) / width, 1);
  uniform float length = 2.6;
  float along = xcomp(q) / length + 0.37 * board, end = mod(along, 1);
  float chance = cellnoise(board, floor(along));
  /* Grain: noise drawn out along the board, no two boards alike. */
  point g = point (1.1 * xcomp(q), 0, 26 * zcomp(q)) + 31 * chance * vector (1, 1, 1);
  float w = filterwidthp(g);
  float grain = 0.5 + 0.5 * fBm(g + 0.7 * filteredvsnoise(point (0.6 * xcomp(q), 0, 3 * zcomp(q)), w / 8), w, 3, 2.1, 0.6);
  float gapz = min(across, 1 - across) * width, gapx = min(end, 1 - end) * length;
  float soft = filterwidth(zcomp(q));
  float gap = (1 - smoothstep(joint / 2, joint / 2 + 0.003 + soft, min(gapz, gapx))) * joint / (joint + 2 * soft);
  normal Nf = faceforward(normalize(N), I);
  color C = Cs * mix(dark, light, clamp(0.75 * grain + 0.5 * (chance - 0.35), 0, 1)) * (1 - 0.8 * gap);
  Oi = 1;
  Ci = C * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * (1 - gap) * specular(Nf, -normalize(I), roughness);
}
