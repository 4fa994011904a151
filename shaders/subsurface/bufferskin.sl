/* bufferskin.sl: skin by shadow maps, without rays and without points: both terms of light below the surface are found by what each light sees of
 * the skin. Relief and an oily coat as pointskin.sl has them.
 *
 *     Ci = (1 - F) (map Ka ambient + mix(map diffuse, diffusion, scatter) + Ksingle single) + Kcoat coat
 *
 * Lights are those that have the parameter skinmap (mapspot.sl): a z picture of the skin alone from the light's place; with innermap also one
 * of the bones, behind which no light goes. Their own shadows, of everything but the skin, are on all that comes of them. Other lights, such
 * as those that fill, stay where they fall. With scatter 0 it is a BRDF to compare with.
 *
 * After "Implementing a Skin BSSRDF" (Hery, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 4, sections 4.3 and 4.5).
 */
#include "skin.h"
#include "subsurface.h"

surface
bufferskin(uniform float scatter = 1;        /* 0 to 1: part of the light that goes below */
           uniform color freepath = color (3.67, 1.37, 0.68); /* mean distance that light goes below, mm: measured on a forearm */
           uniform float mm = 1;             /* the length of a millimetre, "current" space */
           uniform float eta = 1.3;          /* index of refraction of the skin, 1 to 2 */
           uniform string map = "";          /* the skin's colour under diffuse light, by s and t, times Cs; at P it counts for all around it */
           uniform float Ka = 1;             /* 0 to 1 */
           uniform float samples = 32;       /* of diffusion, for each light */
           uniform float Ksingle = 0;        /* 0 to 1 */
           uniform float g = 0.6;            /* mean cosine of scattering, -1 to 1 */
           uniform float singlesamples = 8;  /* of single scattering, for each light */
           uniform float innersoft = 1;      /* mm behind the bones at which light is gone */
           uniform float blur = 0;           /* of what the lights see of skin and bones, a part of their maps: lights that are no points */
           uniform float cell = 2, depth = 0.12; /* of the relief: width of cells and depth of creases, mm; 0: smooth */
           uniform float Kcoat = 1;          /* 0 to 1 */
           uniform float coateta = 1.4;      /* index of refraction of the oil, 1 to 2 */
           uniform float oily = 0.16, rough = 0.38; /* slopes of two layers, 0.02 to 0.5 */
           uniform float oiliness = 0.35;    /* 0 to 1: part of the first */
           output varying color deep = 0, single = 0; /* the parts */
           )
{
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In), Nb = Nf;
  color albedo = Cs;
  if (map != "") albedo *= color texture(map);
  if (depth > 0) {
    point q = transform("shader", P) / (cell * mm);
    Nb = bumped(P, Nf, faceforward(normalize(Ng), In), depth * mm * skinrelief(q, filterwidthp(q)));
  }
  color plain = 0, lit = 0, coat = 0;
  if (scatter < 1) lit = albedo * diffuse(Nb);
  if (scatter > 0) {
    color sigma_a = 0, sigma_s = 0;
    mediumof(albedo, mm * freepath, g, eta, sigma_a, sigma_s);
    illuminance(P, Nf, PI) {
      uniform string skin = "", normals = "", inner = "";
      lightsource("skinmap", skin);
      lightsource("skinnormals", normals);
      lightsource("innermap", inner);
      if (skin != "") {
        deep += Cl * diffusionscatteringbymap(P, L, albedo, mm * freepath, eta, samples, skin, inner, innersoft * mm,
                                                blur);
        if (Ksingle > 0)
          single += Cl * singlescatteringbymap(P, Nf, In, L, sigma_a, sigma_s, g, eta, singlesamples, skin, normals, inner,
                                                       innersoft * mm, blur);
      } else
        plain += Cl * max(normalize(L) . Nb, 0);
    }
    lit = mix(lit, deep + albedo * plain, scatter) + scatter * Ksingle * single;
  }
  if (Kcoat > 0) coat = skincoat(P, Nb, -In, coateta, oily, rough, oiliness);
  Oi = Os;
  Ci = Os * (fresneltransmittance(-(In . Nf), eta) * (lit + Ka * albedo * ambient()) + Kcoat * coat);
}
