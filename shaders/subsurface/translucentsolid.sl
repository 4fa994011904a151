/* translucentsolid.sl: marble, milk, skin, wax: light that goes in and comes out elsewhere, by a cloud of points that were lit in a pass before,
 * by once scattered light along rays, and by reflection.
 *
 *     Ci = (1 - F) (Kdiffuse deep + Ksingle single) + Kspecular F coat
 *
 * Passes: points spread evenly by repulsion (bakemesh.sl and slpoints) or from the grids (bakepoints.sl); light on them (lightpoints.sl); the
 * picture, in which groups of far points count as one each. With Kdiffuse 0 and Kbrdf 1 it is the same material without anything below: a
 * BRDF to compare with.
 *
 * After "A Rapid Hierarchical Rendering Technique for Translucent Materials" (Jensen, Buhler, 2002).
 */
#include "subsurface.h"
#include "pointscattering.h"

surface
translucentsolid(uniform string cloud = "";     /* lit points, "world" space */
                 uniform string material = "";  /* a measured one: "marble", "skin1", "wholemilk"... */
                 uniform float mm = 1;          /* the length of a millimetre in the scene, above 0 */
                 /* Without a material: */
                 uniform color albedo = .8;     /* under diffuse light, 0 to 1 */
                 uniform color freepath = 1;    /* how far light spreads: the mean, "world" space, above 0 */
                 uniform float textured = 0;    /* 1: with the colours of the points in place of albedo */
                 uniform float eta = 1.3;       /* index of refraction, 1 to 2 */
                 uniform float g = 0;           /* mean cosine of scattering, -1 to 1 */
                 uniform float Kdiffuse = 1, Ksingle = 0, Kspecular = 1; /* 0 to 1 */
                 uniform float Kbrdf = 0;       /* 0 to 1: diffuse light by Cs instead */
                 uniform string map = "";       /* its colours, by s and t, times Cs */
                 uniform float roughness = .1;  /* of the highlight, 0.01 to 1 */
                 uniform float samples = 8;     /* rays of single scattering for each light */
                 uniform string subset = "";    /* the group that they see; "": all */
                 uniform string inner = "";     /* a cloud on what is inside and takes light away */
                 uniform float blocking = .5;   /* how much of its light, 0 to 1 */
                 )
{
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  float out = fresneltransmittance(-(In . Nf), eta);
  color deep = 0, single = 0, plain = 0;
  if (Kdiffuse != 0) {
    if (material != "")
      deep = scatteredmaterial(P, cloud, material, mm);
    else if (textured != 0)
      deep = scatteredtextured(P, cloud, freepath, eta);
    else if (inner != "")
      deep = scatteredround(P, cloud, inner, blocking, albedo, freepath, eta);
    else
      deep = scattered(P, cloud, albedo, freepath, eta);
  }
  if (Ksingle != 0) {
    color sigma_a = 0, sigma_s = 0;
    mediumof(albedo, freepath, g, eta, sigma_a, sigma_s);
    illuminance(P, Nf, PI)
      single += Cl * singlescattering(P, Nf, In, L, sigma_a, sigma_s, g, eta, samples, subset);
  }
  if (Kbrdf != 0) {
    color painted = Cs;
    if (map != "") painted *= color texture(map);
    plain = painted * diffuse(Nf);
  }
  Oi = Os;
  Ci = Os * (out * (Kdiffuse * deep + Kbrdf * plain + Ksingle * single) + Kspecular * (1 - out) * specular(Nf, -In, roughness));
}
