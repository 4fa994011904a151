/* environmentlit.sl: matte, lit by an environment map, as far as other things do not hide it. In four ways:
 *
 *             lookup = "direction"                          lookup = "each"
 *   gather    the mean direction of rays that hit nothing,  the map where each of these rays goes
 *   occlusion looked up once in a map that is much blurred  the same, interpolated
 *
 * The one direction is wrong where it leads into something: right under an object, where the sky is a rim around it.
 */
surface
environmentlit(uniform string method = "occlusion"; /* or "gather" */
               uniform string lookup = "each";      /* or "direction" */
               uniform string envmap = "";          /* latitudes and longitudes, or a cube */
               uniform string envspace = "world";   /* its axes */
               uniform float blur = 0;              /* of lookups, as a part of the map */
               uniform float samples = 64;          /* rays a point */
               uniform float Kd = 1;                /* part of the light that is reflected, 0 to 1 */
               output varying float occluded = 0;   /* part of the half space that is hidden */
               )
{
  normal Ns = shadingnormal(N);
  color lit = 0;
  vector direction = 0, open = 0;

  if (method == "gather" && lookup == "each") {
    gather("occlusion", P, Ns, PI / 2, samples, "distribution", "cosine", "ray:direction", direction) {
      occluded += 1;
    } else {
      lit += color environment(envmap, vtransform(envspace, direction), "blur", blur);
    }
    lit /= samples;
    occluded /= samples;
  } else if (lookup == "each") {
    occluded = occlusion(P, Ns, samples, "environmentmap", envmap, "environmentspace", envspace, "environmentcolor", lit);
  } else {
    if (method == "gather") {
      gather("occlusion", P, Ns, PI / 2, samples, "distribution", "cosine", "ray:direction", direction) {
        occluded += 1;
      } else {
        open += direction;
      }
      occluded /= samples;
    } else {
      occluded = occlusion(P, Ns, samples, "environmentdir", open);
    }
    if (length(open) > 0)
      lit = (1 - occluded) * color environment(envmap, vtransform(envspace, normalize(open)), "blur", blur);
  }
  Oi = Os;
  Ci = Os * Cs * Kd * lit;
}
