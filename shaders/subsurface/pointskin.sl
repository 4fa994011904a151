/* pointskin.sl: skin by clouds of points that were lit in a pass before: diffusion from points that each have their own colour, less what
 * bones below take away; light that is scattered once, by rays; relief; an oily coat.
 *
 *     Ci = (1 - F) (mix(diffuse, diffusion - blocking bones, scatter) + Ksingle single) + Kcoat coat
 *
 * Passes: bakepoints.sl over the skin, and over what is inside it; lightpoints.sl among all lights, many of them for what comes from all
 * around; then the picture, for which no light is asked about what lies below the surface. With scatter 0 it is the same skin without
 * anything below: a BRDF to compare with.
 *
 * After "Implementing a Skin BSSRDF" (Hery, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 4).
 */
#define SUBSURFACE_EPSILON 0.15 /* grain of 3 %, below that of the points themselves */
#include "skin.h"
#include "subsurface.h"
#include "pointscattering.h"

surface
pointskin(/* Light below the surface. */
          uniform string cloud = "";       /* lit points, "world" space */
          uniform string coarse = "";      /* the same skin in fewer points, for what is farther than near; "": cloud serves for all */
          uniform float near = 0.2;        /* above 0, "world" space; some mean free paths */
          uniform float scatter = 1;       /* 0 to 1: part of the light that goes below */
          uniform color freepath = color (3.67, 1.37, 0.68); /* mean distance that light goes below, mm: measured on a forearm */
          uniform float mm = 1;            /* the length of a millimetre, "world" space */
          uniform float eta = 1.3;         /* index of refraction of the skin, 1 to 2 */
          uniform string map = "";         /* the skin's colour under diffuse light, by s and t, times Cs; that of the points counts below */
          /* What is inside. */
          uniform string inner = "";       /* points on bones, lit as the skin's; "": none */
          uniform float blocking = 0.5;    /* 0 to 1: how much they take away */
          /* Light that is scattered once. */
          uniform float Ksingle = 0;       /* 0 to 1 */
          uniform string throughlights = "through"; /* category of lights that shine through: no shadow of the skin, __nondiffuse 1 */
          uniform float g = 0.6;           /* mean cosine of scattering, -1 to 1 */
          uniform float samples = 8;       /* rays for each such light */
          uniform string subset = "";      /* the group of objects that is skin, for these rays; "": all */
          /* The surface. */
          uniform float cell = 2, depth = 0.12; /* of its relief: width of cells and depth of creases, mm; 0: smooth */
          uniform float Kcoat = 1;         /* 0 to 1 */
          uniform float coateta = 1.4;     /* index of refraction of the oil, 1 to 2 */
          uniform float oily = 0.16, rough = 0.38; /* slopes of two layers, 0.02 to 0.5 */
          uniform float oiliness = 0.35;   /* 0 to 1: part of the first */
          output varying color deep = 0, single = 0, coat = 0; /* the parts, for pictures of their own */
          )
{
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In), Nb = Nf;
  color albedo = Cs;
  if (map != "") albedo *= color texture(map);
  if (depth > 0) {
    uniform float unit = mm * length(vtransform("world", "current", vector (0, 1, 0)));
    point q = transform("shader", P) / (cell * mm);
    Nb = bumped(P, Nf, faceforward(normalize(Ng), In), depth * unit * skinrelief(q, filterwidthp(q)));
  }
  float out = fresneltransmittance(-(In . Nf), eta);
  color lit = 0;
  if (scatter < 1) lit = albedo * diffuse(Nb);
  if (scatter > 0 && cloud != "") {
    deep = coarse == "" ? scatteredtextured(P, cloud, mm * freepath, eta)
                        : scatteredlevels(P, cloud, coarse, near, mm * freepath, eta);
    if (inner != "") deep = lesslight(deep, blocking * scatteredtextured(P, inner, mm * freepath, eta));
    lit = mix(lit, deep, scatter);
  }
  if (Ksingle > 0 && scatter > 0) {
    color sigma_a = 0, sigma_s = 0;
    mediumof(albedo, mm * freepath, g, eta, sigma_a, sigma_s);
    illuminance(throughlights, P, Nf, PI)
      single += Cl * singlescattering(P, Nf, In, L, sigma_a, sigma_s, g, eta, samples, subset);
    lit += scatter * Ksingle * single;
  }
  if (Kcoat > 0) coat = skincoat(P, Nb, -In, coateta, oily, rough, oiliness);
  Oi = Os;
  Ci = Os * (out * lit + Kcoat * coat);
}
