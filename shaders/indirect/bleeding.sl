/* bleeding.sl: matte, lit by lamps and by one bounce of light from other surfaces and the sky.
 *
 * The bounce is not looked for where Attribute "trace" "maxdiffusedepth" forbids it: 0 leaves what matte.sl gives.
 */
surface
bleeding(uniform float Kd = 1;                      /* part of all light that is reflected, 0 to 1 */
         uniform float Kindirect = 1;               /* strength of the bounce; 0: none */
         uniform string method = "indirectdiffuse"; /* or "gather": at every point, without interpolation */
         uniform float samples = 64;                /* rays a point */
         uniform float minsamples = 0;   /* adaptive from so many; 0: not */
         uniform float maxdist = 1e30;   /* farther surfaces give nothing */
         uniform string envmap = "";     /* light from where there is no surface; "": none */
         uniform string envspace = "world"; /* the axes of envmap */
         output varying color indirect = 0; /* the light of the bounce, before Cs and Kd */
         )
{
  normal Ns = shadingnormal(N);
  if (Kindirect > 0) {
    if (method == "gather") {
      color seen = 0;
      vector direction = 0;
      gather("illuminance", P, Ns, PI / 2, samples, "distribution", "cosine", "surface:Ci", seen, "ray:direction", direction,
             "maxdist", maxdist) {
        indirect += seen;
      } else {
        if (envmap != "")
          indirect += color environment(envmap, vtransform(envspace, direction));
      }
      indirect /= samples;
    } else {
      uniform float first = minsamples > 0 ? minsamples : samples;
      indirect = indirectdiffuse(P, Ns, samples, "minsamples", first, "maxdist", maxdist, "environmentmap", envmap,
                                 "environmentspace", envspace);
    }
  }
  Oi = Os;
  Ci = Os * Cs * Kd * (diffuse(Ns) + Kindirect * indirect);
}
