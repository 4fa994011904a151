/* scatterskin.sl: skin by scatter maps, their samples lit on the fly, mixed with plain diffuse light that keeps what is fine. */
#include "scattermap.h"

surface
scatterskin(uniform string map = "";
            uniform float width = .1;         /* how far light spreads, in "world" space */
            uniform color tint = 1;
            uniform float amount = .7;        /* part of the light that spreads */
            uniform float Ka = 0, Kd = 1, Ks = .2, roughness = .2;
            output varying float __overrideDerivs = 0, __derivA = 0;
            )
{
  normal Nn = normalize(N), Nf = faceforward(Nn, I);
  /* First of all: what re-lights pictures keeps all that comes before. */
  color plain = diffuse(Nn);
  color spread = scattermap(P, Nn, map, width, tint, __overrideDerivs, __derivA);
  Oi = Os;
  Ci = Os * (Cs * (Ka * ambient() + Kd * mix(plain, spread, amount)) + Ks * specular(Nf, -normalize(I), roughness));
}
