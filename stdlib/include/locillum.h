/* locillum.h: local illumination beyond diffuse() and specular(). N and V are of unit length, N faces V.
 */
#ifndef ANEMONE_LOCILLUM_H
#define ANEMONE_LOCILLUM_H

/* Rough diffuse surfaces, such as clay (Oren and Nayar 1994, the qualitative model); roughness is the standard
 * deviation of the slopes in radians.
 */
color LocIllumOrenNayar(normal N; vector V; float roughness) {
  extern point P;
  color total = 0;
  float squared = roughness * roughness;
  float A = 1 - 0.5 * squared / (squared + 0.33), B = 0.45 * squared / (squared + 0.09);
  float view_cosine = V . N, view_angle = acos(view_cosine);
  vector view_in_plane = normalize(V - vector N * view_cosine);
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nondiffuse = 0;
    lightsource("__nondiffuse", nondiffuse);
    vector Ln = normalize(L);
    float light_cosine = Ln . N, light_angle = acos(light_cosine);
    float between = max(view_in_plane . normalize(Ln - vector N * light_cosine), 0);
    float alpha = max(light_angle, view_angle), beta = min(light_angle, view_angle);
    total += Cl * ((1 - nondiffuse) * light_cosine * (A + B * between * sin(alpha) * tan(min(beta, 1.57))));
  }
  return total;
}

/* Brushed metal (Ward 1992): highlights of another width along xdir than across it. */
color LocIllumWardAnisotropic(normal N; vector V; vector xdir; float xroughness; float yroughness) {
  extern point P;
  color total = 0;
  float view_cosine = max(N . V, 0.001);
  vector X = xdir / xroughness, Y = (vector N ^ xdir) / yroughness;
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nonspecular = 0;
    lightsource("__nonspecular", nonspecular);
    if (nonspecular < 1) {
      vector Ln = normalize(L), H = normalize(V + Ln);
      float light_cosine = max(N . Ln, 0.001);
      float slope = ((X . H) * (X . H) + (Y . H) * (Y . H)) / (1 + H . N);
      float rho = exp(-2 * slope) / sqrt(light_cosine * view_cosine);
      total += Cl * ((1 - nonspecular) * light_cosine * rho / (4 * xroughness * yroughness));
    }
  }
  return total;
}

/* Highlights with an edge, as on glazed ceramics: specular() through a step of the given sharpness, 0 to 1. */
color LocIllumGlossy(normal N; vector V; float roughness; float sharpness) {
  extern point P;
  color total = 0;
  float edge = 0.18 * (1 - sharpness);
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nonspecular = 0;
    lightsource("__nonspecular", nonspecular);
    if (nonspecular < 1) {
      vector H = normalize(normalize(L) + V);
      float highlight = pow(max(N . H, 0), 1 / roughness);
      total += Cl * ((1 - nonspecular) * smoothstep(edge, 0.72 - edge, highlight));
    }
  }
  return total;
}

#endif
