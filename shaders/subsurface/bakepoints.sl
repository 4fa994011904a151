/* bakepoints.sl: a point for each micropolygon, into a cloud that is written when the frame ends. lit: with the light that falls there now.
 * What the camera does not see is not baked: Attribute "cull" "hidden" 0 and "backfacing" 0 keep it, and "dice" "rasterorient" 0 makes it as
 * fine as the rest.
 */
#include "subsurface.h"

surface
bakepoints(uniform string file = "points.ply"; /* that is written */
           uniform float lit = 0;   /* 1: with their light */
           uniform string map = ""; /* colours of the points, by s and t */
           )
{
  color albedo = Cs;
  normal Nn = normalize(N);
  if (map != "") albedo *= color texture(map);
  point at = transform("world", P);
  normal facing = normalize(ntransform("world", Nn));
  if (lit != 0)
    bakepoints(file, at, facing, albedo, lightat(P, Nn));
  else
    bakepoints(file, at, facing, albedo);
  Ci = Oi = 1;
}
