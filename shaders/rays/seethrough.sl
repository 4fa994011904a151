/* seethrough.sl: a mirror, in three ways to deal with surfaces that let light through. Only the first is wrong.
 *
 *   "nearest"   gather: the nearest surface, with its empty places as black as if they were something
 *   "traverse"  one ray through all surfaces, front to back, until what it met is opaque
 *   "step"      the same by gathers that begin anew behind each hit: the way without traverse, slower
 */
surface
seethrough(uniform string method = "traverse"; /* see above */
           uniform float Kr = 1;               /* part of light that is mirrored, 0 to 1; times Cs */
           uniform color background = 0;    /* what is seen where there is nothing */
           uniform string envmap = "";      /* or a map of it, in space "world" */
           uniform float threshold = 0.996; /* opacity that counts as opaque */
           uniform float steps = 8;         /* hits that "step" takes into account */
           output varying float met = 0;    /* surfaces that were met */
           )
{
  normal Nf = faceforward(normalize(N), I);
  vector R = normalize(reflect(I, Nf));
  color sum = 0, through = 1, c = 0, o = 0;

  if (method == "nearest") {
    gather("illuminance", P, R, 0, 1, "surface:Ci", c) {
      sum = c;
      through = 0;
      met += 1;
    }
  } else if (method == "traverse") {
    traverse("illuminance", P, R, "surface:Ci", c, "surface:Oi", o) {
      sum += through * c;
      through *= 1 - o;
      met += 1;
      if (max(comp(through, 0), comp(through, 1), comp(through, 2)) < 1 - threshold)
        break;
    }
  } else {
    point from = P;
    float distance = 0, i, more = 1;
    for (i = 0; i < steps && more > 0; i += 1) {
      more = 0;
      gather("illuminance", from, R, 0, 1, "surface:Ci", c, "surface:Oi", o, "ray:length", distance) {
        sum += through * c;
        through *= 1 - o;
        met += 1;
        more = 1;
      }
      from += distance * R;
      if (max(comp(through, 0), comp(through, 1), comp(through, 2)) < 1 - threshold)
        more = 0;
    }
  }
  color behind = background;
  if (envmap != "")
    behind = color environment(envmap, vtransform("world", R));
  Oi = Os;
  Ci = Os * Cs * Kr * (sum + through * behind);
}
