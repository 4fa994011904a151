/* Built-in functions written in the language: light reflected by simple surfaces (RISpec 3.2, 15.6). How these bodies
 * are found: mathematics.sl. N is of unit length and faces the viewer, V points to the viewer.
 */

color diffuse(normal N) {
  extern point P;
  color total = 0;
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nondiffuse = 0;
    lightsource("__nondiffuse", nondiffuse);
    total += Cl * ((normalize(L) . N) * (1 - nondiffuse));
  }
  return total;
}

color diffuse(point p; normal N; float angle) {
  color total = 0;
  illuminance (p, N, angle) {
    extern vector L;
    extern color Cl;
    float nondiffuse = 0;
    lightsource("__nondiffuse", nondiffuse);
    total += Cl * ((normalize(L) . N) * (1 - nondiffuse));
  }
  return total;
}

/* RISpec's example has 1/roughness; renderers have always used 8/roughness, and scenes were tuned to it. */
color specularbrdf(vector L; normal N; vector V; float roughness) {
  vector H = normalize(L + V);
  return pow(max(0, N . H), 8 / roughness);
}

color specular(normal N; vector V; float roughness) {
  extern point P;
  color total = 0;
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nonspecular = 0;
    lightsource("__nonspecular", nonspecular);
    total += Cl * specularbrdf(normalize(L), N, V, roughness) * (1 - nonspecular);
  }
  return total;
}

color phong(normal N; vector V; float size) {
  extern point P;
  color total = 0;
  vector R = reflect(-normalize(V), vector normalize(N));
  illuminance (P, N, PI / 2) {
    extern vector L;
    extern color Cl;
    float nonspecular = 0;
    lightsource("__nonspecular", nonspecular);
    total += Cl * (pow(max(0, R . normalize(L)), size) * (1 - nonspecular));
  }
  return total;
}

/* The light that lamps send by mirrors and lenses: a lookup in the map that the object names. */
color caustic(point P; normal N; uniform float estimator = 50; uniform float maxdist = 1e30) {
  uniform string map = "";
  attribute("photon:causticmap", map);
  color light = 0;
  if (map != "")
    light = photonmap(map, P, N, "estimator", estimator, "maxdist", maxdist);
  return light;
}
