/* indirectlight.sl: one bounce of light from other surfaces, for shaders that know only diffuse(). */
light
indirectlight(uniform float intensity = 1;
              uniform color filter = 1;
              uniform float samples = 64;
              uniform float maxdist = 1e30;
              uniform string envmap = "";
              uniform string envspace = "world";
              output float __nonspecular = 1;
              )
{
  normal Nf = shadingnormal(N);
  illuminate(Ps + Nf) {
    Cl = intensity * filter * indirectdiffuse(Ps, Nf, samples, "maxdist", maxdist, "environmentmap", envmap, "environmentspace", envspace);
  }
}
