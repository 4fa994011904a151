/* cosinelight_rts.sl: cosinelight under the name, and with the parameters, that scenes of 2003 know: sharp shadows, looking down. */
#include "tracedshadow.h"

light
cosinelight_rts(uniform float intensity = 1; /* brightness at distance 1 straight below */
                uniform color lightcolor = 1; /* of the lamp */
                uniform point from = point "shader" (0, 0, 0); /* where it is */
                )
{
  uniform vector axis = vector "shader" (0, -1, 0);
  illuminate(from, axis, PI / 2) {
    Cl = intensity * lightcolor * cosinefalloff(L, axis, 2) * softshadow(Ps, from, 0, 1);
  }
}
