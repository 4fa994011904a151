/* Ambient occlusion by a loop over rays. */
surface rays_occlusion(float samples = 64) {
  float hits = 0;
  gather ("occlusion", P, N, PI / 2, samples, "distribution", "cosine", "samplebase", 0) {
    hits += 1;
  }
  Ci = 1 - hits / samples;
}
