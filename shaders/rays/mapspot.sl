/* mapspot.sl: a spotlight with a shadow map.
 *
 *     Cl = intensity lightcolor c^beamdistribution / |L|^2 edge (1 - shadow)
 *
 * c is the cosine between axis and L. The map is a z picture from the light's place (MakeShadow or a "zfile" Display). Samples of a scatter
 * map, which lie anywhere on the surface, are filtered by their own size: the surface says so by messages (mapshadow.h).
 */
#include "mapshadow.h"

light
mapspot(float intensity = 1;                   /* brightness at distance 1 on the axis */
        color lightcolor = 1;                  /* of the lamp */
        point from = point "shader" (0, 0, 0); /* where the lamp is */
        point to = point "shader" (0, 0, 1);   /* where it looks */
        float coneangle = radians(30);         /* from the axis to the edge of the cone */
        float conedeltaangle = radians(5);     /* width of the soft edge, inside the cone */
        float beamdistribution = 2;            /* the larger, the faster the light falls off beside the axis */
        string shadowmap = "";                 /* "": no shadows */
        float shadowblur = 0.005;              /* 0 to 1: softness of their edges, a part of the map */
        /* Maps from the same place that surfaces may ask for, as bufferskin.sl does; they cast no shadows. */
        string skinmap = "";                   /* the translucent thing alone */
        string skinnormals = "";               /* its normals, in the light's camera space */
        string innermap = "";                  /* what is inside it */
        )
{
  uniform vector A = normalize(to - from);
  illuminate(from, A, coneangle) {
    float c = (L . A) / length(L);
    float falloff = pow(c, beamdistribution) / (L . L) * smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c);
    float dark = 0;
    if (shadowmap != "" && falloff > 0) dark = mapshadow(shadowmap, Ps, L, shadowblur);
    Cl = falloff * (1 - dark) * intensity * lightcolor;
  }
}
