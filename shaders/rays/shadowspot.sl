/* shadowspot.sl: a spotlight whose shadows are traced: hard, or soft as those of a round lamp, and coloured by what lets a part of
 * the light through.
 *
 *     Cl = intensity lightcolor c^beamdistribution / |L|^2 edge transmission(Ps, from)
 *
 * c is the cosine between axis and L. Rays go from the surface in a cone towards the lamp, so shadows are sharp where the thing that casts
 * them touches the surface, and softer the farther away it is. Objects cast shadows by Attribute "visibility" "transmission". With a
 * shadow map (MakeShadow, or Display mode "z") in shadowname the light has its shadows instead, as scenes of other renderers expect of a
 * light of this name.
 */
#include "mapshadow.h"
#include "tracedshadow.h"

light
shadowspot(float intensity = 1;                   /* brightness at distance 1 on the axis */
           color lightcolor = 1;                  /* of the lamp */
           point from = point "shader" (0, 0, 0); /* where the lamp is */
           point to = point "shader" (0, 0, 1);   /* where it looks */
           float coneangle = radians(30);         /* from the axis to the edge of the cone */
           float conedeltaangle = radians(5);     /* width of the soft edge, inside the cone */
           float beamdistribution = 2;            /* the larger, the faster the light falls off beside the axis */
           string shadowname = "";                /* a shadow map instead of rays; "" and "raytrace": rays */
           float samples = 1;                     /* shadow rays a point */
           float minsamples = 0;                  /* where so many agree, no more are shot; 0: always all */
           float blur = 0;                        /* half angle of the cone of rays, radians; a part of the map */
           float radius = 0;                      /* of the lamp: the cone that it fills is taken in place of blur; 0: blur counts */
           float bias = -1;                       /* negative: that of the surface */
           string subset = "";                    /* the groups of objects that cast shadows; "": all */
           float __nondiffuse = 0;                /* 1: not for diffuse() */
           float __nonspecular = 0;               /* 1: not for specular() */
           string __category = "";                /* names by which light loops choose */
           )
{
  uniform vector A = normalize(to - from);
  illuminate(from, A, coneangle) {
    float distance = length(L);
    float c = (L . A) / distance;
    float falloff = pow(c, beamdistribution) / (distance * distance);
    falloff *= smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c);
    float cone = radius > 0 ? atan(radius, distance) : blur;
    color through = 1;
    if (shadowname == "" || shadowname == "raytrace")
      through = shadowthrough(Ps, from, samples, minsamples, cone, bias, subset);
    else
      through = 1 - mapshadow(shadowname, Ps, L, blur);
    Cl = falloff * intensity * lightcolor * through;
  }
}
