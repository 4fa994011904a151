/* Light from other surfaces by a loop over rays. */
surface rays_bleeding(float samples = 64) {
  color seen = 0, sum = 0;
  gather ("illuminance", P, N, PI / 2, samples, "distribution", "cosine", "surface:Ci", seen) {
    sum += seen;
  }
  Ci = sum / samples;
}
