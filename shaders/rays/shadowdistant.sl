/* shadowdistant.sl: parallel light whose shadows are traced: hard, or soft as those of a round lamp far away.
 *
 *     Cl = intensity lightcolor transmission(Ps, far away against the light)
 *
 * Objects cast shadows by Attribute "visibility" "transmission". With a shadow map (MakeShadow, or Display mode "z") in shadowname the
 * light has its shadows instead, as scenes of other renderers expect of a light of this name.
 */
#include "mapshadow.h"
#include "tracedshadow.h"

light
shadowdistant(float intensity = 1;                   /* brightness */
              color lightcolor = 1;                  /* of the light */
              point from = point "shader" (0, 0, 0); /* only the direction from one to the other counts */
              point to = point "shader" (0, 0, 1);   /* where it shines to */
              string shadowname = "";                /* a shadow map instead of rays; "" and "raytrace": rays */
              float samples = 1;                     /* shadow rays a point */
              float minsamples = 0;                  /* where so many agree, no more are shot; 0: always all */
              float blur = 0;                        /* half angle of the lamp, radians (0.0047: the sun); a part of the map */
              float bias = -1;                       /* negative: that of the surface */
              float far = 1e4;                       /* nothing farther away casts shadows, "current" space */
              string subset = "";                    /* the groups of objects that cast shadows; "": all */
              float __nondiffuse = 0;                /* 1: not for diffuse() */
              float __nonspecular = 0;               /* 1: not for specular() */
              string __category = "";                /* names by which light loops choose */
              )
{
  uniform vector axis = normalize(to - from);
  solar(axis, 0) {
    color through = 1;
    if (shadowname == "" || shadowname == "raytrace")
      through = shadowthrough(Ps, Ps - far * axis, samples, minsamples, blur, bias, subset);
    else
      through = 1 - mapshadow(shadowname, Ps, L, blur);
    Cl = intensity * lightcolor * through;
  }
}
