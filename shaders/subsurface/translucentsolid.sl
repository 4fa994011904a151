/* translucentsolid.sl: marble, milk, skin, wax: light that goes in and comes out elsewhere, by a cloud of points that were lit in a pass before
 * (bakepoints.sl, lightpoints.sl), by once scattered light along rays, and by reflection.
 */
#include "subsurface.h"
#include "pointscattering.h"

surface
translucentsolid(uniform string cloud = "";
                 uniform string material = "";  /* a measured one: "marble", "skin1", "wholemilk"... */
                 uniform float mm = 1;          /* the length of a millimetre in the scene */
                 /* without a material: */
                 uniform color albedo = .8;     /* under diffuse light */
                 uniform color freepath = 1;    /* how far light spreads */
                 uniform float textured = 0;    /* 1: with the colours of the points in place of albedo */
                 uniform float eta = 1.3, g = 0;
                 uniform float Kdiffuse = 1, Ksingle = 0, Kspecular = 1, roughness = .1;
                 uniform float samples = 8;     /* rays of single scattering for each light */
                 uniform string subset = "";    /* the group that they see */
                 uniform string inner = "";     /* a cloud on what is inside and takes light away */
                 uniform float blocking = .5;
                 )
{
  vector In = normalize(I);
  normal Nf = faceforward(normalize(N), In);
  float out = fresneltransmittance(-(In . Nf), eta);
  color deep = 0, single = 0;
  if (material != "")
    deep = scatteredmaterial(P, cloud, material, mm);
  else if (textured != 0)
    deep = scatteredtextured(P, cloud, freepath, eta);
  else if (inner != "")
    deep = scatteredround(P, cloud, inner, blocking, albedo, freepath, eta);
  else
    deep = scattered(P, cloud, albedo, freepath, eta);
  if (Ksingle != 0) {
    color sigma_a = 0, sigma_s = 0;
    mediumof(albedo, freepath, g, eta, sigma_a, sigma_s);
    illuminance(P, Nf, PI)
      single += Cl * singlescattering(P, Nf, In, L, sigma_a, sigma_s, g, eta, samples, subset);
  }
  Oi = Os;
  Ci = Os * (out * (Kdiffuse * deep + Ksingle * single) + Kspecular * (1 - out) * specular(Nf, -In, roughness));
}
