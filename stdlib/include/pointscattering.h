/* pointscattering.h: light below the surface by point clouds that were lit before, with the functions of subsurface.so
 * (docs/subsurface.md). P is in "current" space, clouds in "world". Results are without Fresnel's terms, as what diffuse() gives.
 *
 * After "Implementing a Skin BSSRDF" (Hery, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 4), and "A Rapid
 * Hierarchical Rendering Technique for Translucent Materials" (Jensen, Buhler, 2002).
 */
#ifndef ANEMONE_POINTSCATTERING_H
#define ANEMONE_POINTSCATTERING_H

/* The solid angle from which a group of points counts as one: docs/subsurface.md has the errors. */
#ifndef SUBSURFACE_EPSILON
#define SUBSURFACE_EPSILON 0.05
#endif

/* A measured material by name; mm: the length of a millimetre in the scene. */
color scatteredmaterial(point P; uniform string cloud; uniform string material; uniform float mm) {
  return diffusion(transform("world", P), cloud, material, mm, SUBSURFACE_EPSILON);
}

/* What is seen: the colour under diffuse light and the diffuse mean free path of each colour. */
color scattered(point P; uniform string cloud; uniform color albedo; uniform color freepath; uniform float eta) {
  return diffusion(transform("world", P), cloud, albedo, freepath, eta, SUBSURFACE_EPSILON);
}

/* With the colours of the points. */
color scatteredtextured(point P; uniform string cloud; uniform color freepath; uniform float eta) {
  return diffusion(transform("world", P), cloud, freepath, eta, SUBSURFACE_EPSILON);
}

/* The same from two clouds of the same surface: points of the coarse one count where they are farther than near, in "world" space. */
color scatteredlevels(point P; uniform string cloud; uniform string coarse; uniform float near; uniform color freepath; uniform float eta) {
  uniform string clouds[2] = {cloud, coarse};
  uniform float radii[1] = {near};
  return diffusion(transform("world", P), clouds, radii, freepath, eta, SUBSURFACE_EPSILON);
}

/* Light less what something takes of it; none is left below 0. */
color lesslight(color light; color taken) {
  return color (max(0, comp(light, 0) - comp(taken, 0)), max(0, comp(light, 1) - comp(taken, 1)), max(0, comp(light, 2) - comp(taken, 2)));
}

/* Something inside takes light away: a part of what points on it would give, were they lit as the outside is. */
color scatteredround(point P; uniform string cloud; uniform string inner; uniform float part; uniform color albedo; uniform color freepath;
                     uniform float eta) {
  return lesslight(scattered(P, cloud, albedo, freepath, eta), part * scattered(P, inner, albedo, freepath, eta));
}

/* Lights the points of a cloud that are left, and writes it with their light. For the surface of something that is not seen: one point
 * (a Points primitive) is enough, many are faster. flip: 1 where normals point inward. map: "", or colours that the light is multiplied by
 * before it spreads (Jensen and Buhler's way to texture), by x and y of each point in mapspace, as s and t; times scale. Lights that filter
 * by the size of micropolygons must do without, as neighbours on this grid lie anywhere.
 */
void lightpoints(uniform string input; uniform string output_file; uniform float flip; uniform string map; uniform string mapspace;
                 uniform color scale) {
  if (opencache(input) == 1) {
    float index = indexcache();
    while (index >= 0) {
      point at = transform("world", "current", getPcache(index));
      normal facing = normalize(ntransform("world", "current", (1 - 2 * flip) * getNcache(index)));
      color light = 0;
      illuminance(at, facing, PI / 2)
        light += Cl * (normalize(L) . facing);
      if (map != "") {
        point q = transform(mapspace, at);
        float ss = xcomp(q), tt = ycomp(q);
        light *= scale * color texture(map, ss, tt, ss, tt, ss, tt, ss, tt);
      }
      accumcache(index, light);
      index = indexcache();
    }
    writecache(output_file);
  }
}

#endif
