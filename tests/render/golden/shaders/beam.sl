/* A thin beam of parallel light that goes through `from` along `direction`; soft at its rim. */
light beam(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0); vector direction = vector "shader" (0, 0, 1);
           float radius = 0.1) {
  vector axis = normalize(direction);
  solar(axis, 0) {
    vector off = Ps - from;
    float far = length(off - axis * (off . axis));
    Cl = intensity * lightcolor * (1 - smoothstep(0.8 * radius, radius, far));
  }
}
