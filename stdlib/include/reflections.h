/* reflections.h: the light that arrives from a direction, out of reflection maps, environment maps of finite size, or
 * rays.
 */
#ifndef ANEMONE_REFLECTIONS_H
#define ANEMONE_REFLECTIONS_H

#include "raysphere.h"

/* Parameters that shaders pass on: the map, its space, its radius (how far away what it shows is), the spread and number
 * of rays.
 */
#define ENVPARAMS envname, envspace, envrad, rayjitter, raysamples
#define DECLARE_ENVPARAMS string envname, envspace; uniform float envrad, rayjitter, raysamples
#define DECLARE_DEFAULTED_ENVPARAMS \
  string envname = "", envspace = "world"; \
  uniform float envrad = 100, rayjitter = 0, raysamples = 1

/* A picture rendered from the mirrored camera, for flat mirrors. */
color ReflMap(string reflname; point P; float blur; output float alpha) {
  point image = transform("NDC", P);
  float ss = xcomp(image), tt = 1 - ycomp(image);
  alpha = float texture(reflname[3], ss, tt, "blur", blur, "fill", 1);
  return color texture(reflname, ss, tt, "blur", blur);
}

/* An environment map on a sphere of radius envrad about the origin of envspace: near walls move as the point does. */
color Environment(string envname; string envspace; uniform float envrad; point P; vector R; float blur;
                  output float alpha) {
  point origin = transform(envspace, P);
  vector direction = normalize(vtransform(envspace, R));
  float near, far;
  if (raysphere(origin, direction, envrad, 1e-4, near, far) > 0)
    direction = vector (origin + near * direction);
  alpha = float environment(envname[3], direction, "blur", blur, "fill", 1);
  return color environment(envname, direction, "blur", blur);
}

/* What rays see along Rdir: nsamples of them, spread by blur and jitter. */
color RayTrace(point P; vector Rdir; float Kr; float blur; float jitter; uniform float nsamples; output float alpha) {
  color total = 0;
  vector R = normalize(Rdir), across = normalize(R ^ vector (ycomp(R), zcomp(R), -xcomp(R))), up = R ^ across;
  uniform float i;
  alpha = 1;
  if (Kr > 0.0001) {
    for (i = 0; i < nsamples; i += 1) {
      float x = (jitter * (float random() - 0.5) + (i + 0.5) / nsamples - 0.5) * blur;
      float y = jitter * (float random() - 0.5) * blur;
      total += trace(P, normalize(R + x * across + y * up));
    }
  }
  return total / nsamples;
}

/* Rays where there are to be any, and the map behind them. */
color SampleEnvironment(point P; vector R; float Kr; float blur; DECLARE_ENVPARAMS) {
  color result = 0;
  float alpha = 0;
  if (envname != "") result = Environment(envname, envspace, envrad, P, R, blur, alpha);
  if (raysamples > 0) {
    float covered;
    result += RayTrace(P, R, Kr, blur, rayjitter, raysamples, covered);
  }
  return Kr * result;
}

#endif
