/* scattermap.h: scattering by scatter maps, whose samples are lit when they are first needed, with the functions of subsurface.so
 * (docs/subsurface.md).
 *
 * After "Human Skin for Finding Nemo" (Tomson, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 5).
 */
#ifndef ANEMONE_SCATTERMAP_H
#define ANEMONE_SCATTERMAP_H

/* What scatters to P, a place of the surface before displacement, in "current" space. width: how far light spreads, in "world" space. Samples
 * of one grid lie anywhere on the surface; lights that filter by the size of micropolygons find that sample's area in the variables
 * __overrideDerivs (1 while samples are lit) and __derivA (in "current" space), which are parameters of the surface shader.
 */
color scattermap(point P; normal N; uniform string map; float width; color tint; output float __overrideDerivs; output float __derivA) {
  point Pworld = transform("world", P);
  normal Nworld = normalize(ntransform("world", N));
  ScatterDSOReadMap(map);
  float index = ScatterDSOAddGridPoint(Pworld, width);
  point Ps = 0;
  normal Ns = 0;
  float area = 0;
  __overrideDerivs = 1;
  while (ScatterDSOGetSample(Ps, Ns, area) == 1) {
    point at = transform("world", "current", Ps);
    normal facing = normalize(ntransform("world", "current", Ns));
    float scale = length(vtransform("world", "current", vector (1, 1, 1))) / sqrt(3);
    __derivA = area * scale * scale;
    color light = 0;
    illuminance(at, facing, PI / 2)
      light += Cl * (normalize(L) . facing);
    ScatterDSOSaveIrradiance(light);
  }
  __overrideDerivs = 0;
  return ScatterDSOScatter(index, Pworld, Nworld, width, tint);
}

#endif
