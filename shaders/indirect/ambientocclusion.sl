/* ambientocclusion.sl: the light of an overcast sky: white, less what is hidden by other things (or by the thing itself).
 *
 * method "gather" shoots rays at every point; "occlusion" calls occlusion(), which interpolates as Attribute "irradiance" "maxerror" allows
 * (0: as much work as gather) and can look at the half space adaptively.
 */
surface
ambientocclusion(uniform string method = "occlusion"; /* or "gather" */
                 uniform float samples = 64;          /* rays a point */
                 uniform float minsamples = 0;        /* adaptive from so many; 0: not. Below 64 there is little to go by */
                 uniform float maxdist = 1e30;        /* things farther away hide nothing */
                 uniform float coneangle = PI / 2;    /* half angle of what counts of the sky */
                 uniform string subset = "";          /* groups that hide; "": all */
                 output varying float occluded = 0;   /* the hidden part, 0 to 1 */
                 )
{
  normal Ns = shadingnormal(N);
  if (method == "gather") {
    float hits = 0;
    gather("occlusion", P, Ns, coneangle, samples, "distribution", "cosine", "maxdist", maxdist, "subset", subset) {
      hits += 1;
    }
    occluded = hits / samples;
  } else {
    uniform float first = minsamples > 0 ? minsamples : samples;
    occluded = occlusion(P, Ns, samples, "minsamples", first, "maxdist", maxdist, "coneangle", coneangle, "subset", subset);
  }
  Oi = Os;
  Ci = Os * Cs * (1 - occluded);
}
