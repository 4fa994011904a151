/* tracedshadow.h: shadows by rays, for light shaders, and the light of small flat lamps. */
#ifndef ANEMONE_TRACEDSHADOW_H
#define ANEMONE_TRACEDSHADOW_H

/* How many shadow rays a point gets: one where a diffuse ray asks for its light, which is averaged over many such points anyway. */
float shadowrays(uniform float samples) {
  uniform float indirect = 0;
  rayinfo("diffusedepth", indirect);
  return indirect > 0 ? 1 : samples;
}

/* Shadow of a round lamp of this radius at `from`: rays from the point in the cone that the lamp fills. Sharp where what casts it is near. */
color softshadow(point Ps; point from; float radius; uniform float samples) {
  return transmission(Ps, from, "samples", shadowrays(samples), "samplecone", atan(radius, distance(Ps, from)));
}

/* Light of a small flat lamp that looks along axis: 1 at distance 1 straight ahead, none to the side and behind. */
float cosinefalloff(vector L; vector axis; float falloff) {
  return max(normalize(L) . normalize(axis), 0) * pow(length(L), -falloff);
}

#endif
