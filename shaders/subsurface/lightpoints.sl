/* lightpoints.sl: lights the points of a cloud and writes it anew, with their light. On a Points primitive or a small polygon that nobody sees
 * (Attribute "cull" "hidden" 0): the light is that of the points, wherever this surface is.
 */
#include "pointscattering.h"

surface
lightpoints(uniform string input = "points.ply"; /* the cloud */
            uniform string result = "lit.ply";   /* that is written */
            uniform float flip = 0;          /* 1: the cloud's normals point inward */
            uniform string map = "";         /* colours for the light before it spreads, by x and y in mapspace, as s and t; "": none */
            uniform string mapspace = "shader"; /* any coordinate system */
            uniform color scale = 1;         /* times the colours: 1 over their mean leaves the material's own colour, above 0 */
            )
{
  lightpoints(input, result, flip, map, mapspace, scale);
  Ci = Oi = 0;
}
