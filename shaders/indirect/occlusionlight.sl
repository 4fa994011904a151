/* occlusionlight.sl: the light of an overcast sky for shaders that know only diffuse(): every point gets what of the sky it sees. */
light
occlusionlight(uniform float intensity = 1; /* of the whole sky */
               uniform color lightcolor = 1; /* of the sky */
               uniform float samples = 64;   /* rays a point */
               uniform float maxdist = 1e30; /* things farther away hide nothing, "current" space */
               uniform float coneangle = PI / 2; /* half angle of what counts of the sky, radians */
               uniform string subset = "";       /* groups that hide; "": all */
               output float __nonspecular = 1;   /* it makes no highlights */
               )
{
  normal Nf = shadingnormal(N);
  /* Straight along the normal: diffuse() then counts it in full. */
  illuminate(Ps + Nf) {
    Cl = intensity * lightcolor * (1 - occlusion(Ps, Nf, samples, "maxdist", maxdist, "coneangle", coneangle, "subset", subset));
  }
}
