/* indirectlight.sl: one bounce of light from other surfaces, for shaders that know only diffuse(). */
light
indirectlight(uniform float intensity = 1; /* strength of the bounce, 1: as it is */
              uniform color filter = 1;    /* times its colour */
              uniform float samples = 64;  /* rays a point */
              uniform float maxdist = 1e30; /* farther surfaces give nothing, "current" space */
              uniform string envmap = "";   /* light from where there is no surface; "": none */
              uniform string envspace = "world"; /* the axes of envmap */
              output float __nonspecular = 1;    /* it makes no highlights */
              )
{
  normal Nf = shadingnormal(N);
  illuminate(Ps + Nf) {
    Cl = intensity * filter * indirectdiffuse(Ps, Nf, samples, "maxdist", maxdist, "environmentmap", envmap, "environmentspace", envspace);
  }
}
