/* material.h: the light leaving surfaces of common materials. Nf is of unit length and faces the viewer. The colour
 * returned is not multiplied by opacity.
 */
#ifndef ANEMONE_MATERIAL_H
#define ANEMONE_MATERIAL_H

#include "locillum.h"
#include "reflections.h"

color MaterialMatte(normal Nf; color basecolor; float Ka; float Kd) {
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf));
}

color MaterialPlastic(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -normalize(I), roughness);
}

/* Metals colour their highlights. */
color MaterialRoughMetal(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, -normalize(I), roughness));
}

/* Leaves, lamp shades: Kt lets light through from behind. */
color MaterialThinPlastic(normal Nf; vector V; color basecolor; float Ka; float Kd; float Kt; float Ks;
                          float roughness) {
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Kt * diffuse(-Nf)) + Ks * specular(Nf, V, roughness);
}

/* Reflections as strong as Fresnel's formula says for the index of refraction; twosided: seen from within, too. */
color MaterialShinyPlastic(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness; float Kr;
                           float blur; float ior; uniform float twosided; DECLARE_ENVPARAMS) {
  extern point P;
  extern vector I;
  extern normal N;
  vector In = normalize(I), R = In;
  float reflected = 0, transmitted = 1;
  if (twosided != 0 || N . I < 0) {
    vector T;
    fresnel(In, vector Nf, 1 / ior, reflected, transmitted, R, T);
    reflected *= Kr;
    transmitted *= 1;
  }
  return transmitted * basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -In, roughness) +
         SampleEnvironment(P, R, reflected, blur, ENVPARAMS);
}

color MaterialShinyMetal(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness; float Kr;
                         float blur; uniform float twosided; DECLARE_ENVPARAMS) {
  extern point P;
  extern vector I;
  extern normal N;
  vector In = normalize(I), R = reflect(In, vector Nf);
  float reflected = Kr;
  if (twosided == 0 && N . I >= 0) reflected = 0;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, -In, roughness) +
                      SampleEnvironment(P, R, reflected, blur, ENVPARAMS));
}

color MaterialClay(normal Nf; color basecolor; float Ka; float Kd; float roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * LocIllumOrenNayar(Nf, -normalize(I), roughness));
}

color MaterialBrushedMetal(normal Nf; color basecolor; float Ka; float Kd; float Ks; vector xdir; float uroughness;
                           float vroughness) {
  extern vector I;
  color highlight = LocIllumWardAnisotropic(Nf, -normalize(I), normalize(xdir), uroughness, vroughness);
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * highlight);
}

color MaterialCeramic(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness; float specsharpness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) +
         Ks * LocIllumGlossy(Nf, -normalize(I), roughness / 10, specsharpness);
}

/* eta is the index of the glass; rays inside go the other way through the surface. */
color MaterialGlass(normal Nf; color basecolor; float Ka; float Kd; float Ks; float roughness; float Kr;
                    float reflblur; float Kt; float refrblur; float eta; color transmitcolor;
                    uniform float refrrayjitter; uniform float refrraysamples; DECLARE_ENVPARAMS) {
  extern point P;
  extern vector I;
  extern normal N;
  vector In = normalize(I), R, T;
  float reflected, transmitted, ratio = N . I < 0 ? 1 / eta : eta;
  fresnel(In, vector Nf, ratio, reflected, transmitted, R, T);
  reflected *= Kr;
  transmitted *= Kt;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * LocIllumGlossy(Nf, -In, roughness / 10, 0.5) +
         SampleEnvironment(P, R, reflected, reflblur, ENVPARAMS) +
         transmitcolor * SampleEnvironment(P, T, transmitted, refrblur, envname, envspace, envrad, refrrayjitter,
                                           refrraysamples);
}

#endif
