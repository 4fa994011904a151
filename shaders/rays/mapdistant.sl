/* mapdistant.sl: parallel light with a shadow map.
 *
 *     Cl = intensity lightcolor (1 - shadow)
 *
 * The map is a z picture by an orthographic camera that looks along the light (MakeShadow or a "zfile" Display); what it does not see is lit.
 * Samples of a scatter map are filtered by their own size, as with mapspot.sl.
 */
#include "mapshadow.h"

light
mapdistant(float intensity = 1;                   /* brightness */
           color lightcolor = 1;                  /* of the light */
           point from = point "shader" (0, 0, 0); /* only the direction from one to the other counts */
           point to = point "shader" (0, 0, 1);   /* where it shines to */
           string shadowmap = "";                 /* "": no shadows */
           float shadowblur = 0.005;              /* 0 to 1: softness of their edges, a part of the map */
           )
{
  uniform vector axis = normalize(to - from);
  solar(axis, 0) {
    float dark = 0;
    if (shadowmap != "") dark = mapshadow(shadowmap, Ps, axis, shadowblur);
    Cl = intensity * lightcolor * (1 - dark);
  }
}
