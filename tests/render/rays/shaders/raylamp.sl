// A light that shoots rays: hits and misses of a gather towards it, and what comes through.
light raylamp(float samples = 4;) {
  illuminate(point(0, 0, -2)) {
    float hits = 0, misses = 0;
    gather("", Ps, -L, 0, samples, "maxdist", length(L)) hits += 1; else misses += 1;
    Cl = color(hits, misses, transmission(Ps, Ps - L));
  }
}
