/* lightpoints.sl: lights the points of a cloud and writes it anew, with their light. On a Points primitive or a small polygon that nobody sees
 * (Attribute "cull" "hidden" 0): the light is that of the points, wherever this surface is.
 */
#include "pointscattering.h"

surface
lightpoints(uniform string input = "points.ply";
            uniform string result = "lit.ply";
            uniform float flip = 0; /* 1: the cloud's normals point inward */
            )
{
  lightpoints(input, result, flip);
  Ci = Oi = 0;
}
