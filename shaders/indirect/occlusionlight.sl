/* occlusionlight.sl: the light of an overcast sky for shaders that know only diffuse(): every point gets what of the sky it sees. */
light
occlusionlight(uniform float intensity = 1;
               uniform color lightcolor = 1;
               uniform float samples = 64;
               uniform float maxdist = 1e30;
               uniform float coneangle = PI / 2;
               uniform string subset = "";
               output float __nonspecular = 1;
               )
{
  normal Nf = shadingnormal(N);
  /* Straight along the normal: diffuse() then counts it in full. */
  illuminate(Ps + Nf) {
    Cl = intensity * lightcolor * (1 - occlusion(Ps, Nf, samples, "maxdist", maxdist, "coneangle", coneangle, "subset", subset));
  }
}
