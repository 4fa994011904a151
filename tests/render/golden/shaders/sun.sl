/* Parallel light with shadows by rays. */
light sun(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0); point to = point "shader" (0, 0, 1)) {
  vector axis = normalize(to - from);
  solar(axis, 0)
    Cl = intensity * lightcolor * transmission(Ps, Ps - 1000 * axis);
}
