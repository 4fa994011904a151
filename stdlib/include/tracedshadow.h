/* tracedshadow.h: shadows by rays, for light shaders, and the light of small flat lamps. Points and lengths are in "current" space. */
#ifndef ANEMONE_TRACEDSHADOW_H
#define ANEMONE_TRACEDSHADOW_H

/* How many shadow rays a point gets: one where a diffuse ray asks for its light, which is averaged over many such points anyway; none where a
 * shadow ray runs the surface's shader. That ray asks for Oi, and surfaces of several things in a row would look for shadows on one
 * another without end.
 */
float shadowrays(uniform float samples) {
  uniform float indirect = 0, inshadow = 0;
  rayinfo("diffusedepth", indirect);
  rayinfo("shadowdepth", inshadow);
  return inshadow > 0 ? 0 : indirect > 0 ? 1 : samples;
}

/* What comes through from the place `from` to Ps, by shadowrays(samples) rays in a cone round the way there. minsamples: where so many
 * agree, no more are shot; 0: always all. cone: its half angle, radians. bias: how far off the surface rays begin; negative: as the surface
 * says. subset: the groups of objects that cast shadows; "": all.
 */
color shadowthrough(point Ps; point from; uniform float samples; uniform float minsamples; float cone; uniform float bias;
                    uniform string subset) {
  color through = 1;
  uniform float rays = shadowrays(samples);
  if (rays > 0) {
    uniform float first = minsamples > 0 ? min(minsamples, rays) : rays;
    through = transmission(Ps, from, "samples", rays, "minsamples", first, "samplecone", cone, "bias", bias, "subset", subset);
  }
  return through;
}

/* Shadow of a round lamp of this radius at `from`: rays from the point in the cone that the lamp fills. Sharp where what casts it is near. */
color softshadow(point Ps; point from; float radius; uniform float samples) {
  return shadowthrough(Ps, from, samples, 0, atan(radius, distance(Ps, from)), -1, "");
}

/* Light of a small flat lamp that looks along axis: cosine times |L|^-falloff, so 1 at distance 1 straight ahead, none to the side and behind. */
float cosinefalloff(vector L; vector axis; float falloff) {
  return max(normalize(L) . normalize(axis), 0) * pow(length(L), -falloff);
}

#endif
