/* guidedspot.sl: a spotlight with traced shadows, and a low shadow map that says where they need be traced: where the map is sure that a point
 * is lit or in shadow, no rays are shot. The rays' picture at a part of their cost.
 *
 *     Cl = intensity lightcolor c^beamdistribution / |L|^2 edge through
 *
 * c is the cosine between axis and L, through what the map knows, or transmission(Ps, from). Map and rays are independent: objects cast
 * shadows by being in the map and by Attribute "visibility" "transmission".
 *
 * After "Programmable Ray Tracing" (Laur, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 2, section 2.6.1).
 */
#include "mapshadow.h"
#include "tracedshadow.h"

light
guidedspot(float intensity = 1;                   /* brightness at distance 1 on the axis */
           color lightcolor = 1;                  /* of the lamp */
           point from = point "shader" (0, 0, 0); /* where the lamp is */
           point to = point "shader" (0, 0, 1);   /* where it looks */
           float coneangle = radians(30);         /* from the axis to the edge of the cone */
           float conedeltaangle = radians(5);     /* width of the soft edge, inside the cone */
           float beamdistribution = 2;            /* the larger, the faster the light falls off beside the axis */
           string shadowmap = "";                 /* a z picture from the light's place, 64 pixels wide will do; "": rays everywhere */
           float grey = 0.1;                      /* how near on the surface to an edge of its shadows rays are shot, "current" space */
           float mapbias = 0.02;                  /* a depth: about a pixel of the map */
           float trace = 1;                       /* 0: no rays; in the grey zone what the map says, filtered */
           float samples = 1;                     /* shadow rays a point */
           float radius = 0;                      /* of the lamp, "current" space */
           float show = 0;                        /* 1: red light where rays are shot */
           )
{
  uniform vector A = normalize(to - from);
  illuminate(from, A, coneangle) {
    float distance = length(L), c = (L . A) / distance;
    float falloff = pow(c, beamdistribution) / (distance * distance) *
                    smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c);
    float dark = falloff <= 0 ? 1 : -1;
    if (shadowmap != "" && dark < 0) dark = suremapshadow(shadowmap, Ps, Ns, grey, mapbias);
    color through = 1 - dark;
    if (dark < 0) {
      if (show != 0)
        through = color (1, 0.1, 0.1);
      else if (trace == 0)
        through = 1 - shadow(shadowmap, Ps, "bias", mapbias);
      else
        through = softshadow(Ps, from, radius, samples);
    }
    Cl = falloff * intensity * lightcolor * through;
  }
}
