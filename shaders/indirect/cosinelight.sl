/* cosinelight.sl: a small flat lamp. Its shadows may fall as if it stood elsewhere: a lamp that is moved for its shadows alone.
 *
 *     Cl = intensity lightcolor cos / |L|^falloff transmission(Ps, from + shadowmove)
 */
#include "tracedshadow.h"

light
cosinelight(uniform float intensity = 1; /* brightness at distance 1 straight ahead */
            uniform color lightcolor = 1;                           /* of the lamp */
            uniform point from = point "shader" (0, 0, 0);          /* where it is */
            uniform vector axis = vector "shader" (0, -1, 0);       /* where it looks */
            uniform float falloff = 2;                              /* 2: as physics says */
            uniform vector shadowmove = vector "shader" (0, 0, 0);  /* from the lamp to where shadows come from */
            uniform float radius = 0, samples = 1;                  /* of soft shadows */
            )
{
  illuminate(from, axis, PI / 2) {
    Cl = intensity * lightcolor * cosinefalloff(L, axis, falloff) * softshadow(Ps, from + shadowmove, radius, samples);
  }
}
