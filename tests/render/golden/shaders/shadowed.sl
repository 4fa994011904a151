/* A distant light from (3, 6, -5) whose light is stopped by a shadow map. */
light shadowed(string map = ""; float blur = 0; float intensity = 1;) {
  solar(vector "world"(-3, -6, 5), 0) {
    Cl = intensity;
    if (map != "")
      Cl *= 1 - shadow(map, Ps, "blur", blur, "samples", 32, "bias", 0.12);
  }
}
