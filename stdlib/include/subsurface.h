/* subsurface.h: both terms of light below the surface, in the shading language: found by rays, or by the shadow maps of lights.
 *
 * Coefficients as in scattering.h, positions in "current" space. Results are without the Fresnel term of the way out, as the two
 * terms share it: multiply by fresneltransmittance().
 *
 * After "Implementing a Skin BSSRDF" (Hery, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 4). Different from its
 * pseudo code, which lacks a factor 1/2 of diffusion, 1 / (4 PI) of the phase function, and a sign of the cosine; which weighs single
 * scattering by 1 / sigma_tc where sampling along the ray leaves 1 / sigma_t; and which takes all light as it is at P.
 */
#ifndef ANEMONE_SUBSURFACE_H
#define ANEMONE_SUBSURFACE_H

#include "axisacross.h"
#include "scattering.h"

/* The radius below which this part of a plane's samples lies, of density exp(-r) / (2 PI) a unit of area: 1 - exp(-r) (1 + r) = xi, by
 * Newton's steps. In the course a table of places serves (mktables makes such); radii that differ from point to point miss nothing of
 * the steep middle of the dipole.
 */
float diffusionradius(float xi) {
  float y = -log(1 - xi), r = y + sqrt(2 * y);
  uniform float i;
  for (i = 0; i < 5; i += 1)
    r -= (r - log(1 + r) - y) * (1 + r) / max(r, 1e-6);
  return max(r, 0);
}

/* Sample i of so many: an offset in the plane of two axes, its length is r. Neighbours in number lie a golden angle apart. Each is spread as
 * one of the three colours is, by turns from the one that is first (by chance: 0, 1 or 2); all serve all three, or colours would separate
 * into grain.
 */
vector diffusionplace(uniform float i; uniform float samples; color freepath; float first; float turn; vector base1; vector base2;
                      output float r) {
  float angle = turn + i * 2.3999632;
  r = comp(freepath, mod(i + first, 3)) * diffusionradius((i + random()) / samples);
  return r * (cos(angle) * base1 + sin(angle) * base2);
}

/* How densely these lie at r: the mean of the three colours' densities (Veach's balance heuristic), so that no colour's steep middle is met by
 * too few.
 */
float diffusiondensity(float r; color freepath) {
  color part = expcolor(-r / freepath) / (freepath * freepath);
  return (comp(part, 0) + comp(part, 1) + comp(part, 2)) / (6 * PI);
}

/* What a sample of single scattering adds, for a light of radiance 1 in a solid angle of 1: light that enters where the normal is Ni, goes
 * in for a straight distance of before, is turned and goes along To (from the eye, refracted) for a distance of after; over the density
 * of such samples, which is the mean of those of the three colours.
 */
color turnedonce(vector To; vector toLight; normal Ni; float before; float after; color sigma_a; color sigma_s; float g; float eta) {
  float cosine = toLight . Ni;
  color sum = 0;
  if (cosine > 0) {
    vector Ti = normalize(refract(-toLight, vector Ni, 1 / eta));
    /* Inside, the light fills less of all directions. */
    float gain = fresneltransmittance(cosine, eta) * cosine / (eta * eta * cosineinside(cosine, eta)) *
                 henyeygreenstein(-(Ti . To), g);
    color sigma_t = sigma_a + sigma_s;
    color density = sigma_t * expcolor(-after * sigma_t);
    float mean = (comp(density, 0) + comp(density, 1) + comp(density, 2)) / 3;
    sum = gain * sigma_s * expcolor(-(refracteddistance(before, cosine, eta) + after) * sigma_t) / mean;
  }
  return sum;
}

/* How deep sample i of so many lies along the refracted ray; turn: which colour's density sample 0 has. */
float turningdepth(float i; float samples; float turn; color sigma_t) {
  return -log(1 - (i + random()) / samples) / comp(sigma_t, mod(i + turn, 3));
}

/* Single scattering of one light, for a loop over lights: `sum += Cl * singlescattering(...)` in illuminance(P, N, PI). To find where
 * its light enters, rays go from places along the refracted view ray towards it, and meet the objects of `subset` ("": all). The light
 * must not be shadowed by the object itself: leave it out of shadow maps, or out of "transmission" rays. Nn faces the eye, Nn and In are
 * of unit length.
 */
color singlescattering(point P; normal Nn; vector In; vector L; color sigma_a; color sigma_s; float g; float eta;
                       uniform float samples; uniform string subset) {
  vector toLight = normalize(L), To = normalize(refract(In, vector Nn, 1 / eta));
  float turn = floor(3 * random()), i;
  color sum = 0;
  for (i = 0; i < samples; i += 1) {
    float after = turningdepth(i, samples, turn, sigma_a + sigma_s), before = 0;
    normal Ni = 0;
    color added = 0;
    gather("", P + after * To, toLight, 0, 1, "primitive:N", Ni, "ray:length", before, "bias", 0, "subset", subset) {
      added = turnedonce(To, toLight, normalize(Ni), before, after, sigma_a, sigma_s, g, eta);
    }
    sum += added;
  }
  return PI * sum / samples;
}

/* Light of all lights at a place of a surface: what diffuse() is at P. */
color lightat(point Pi; normal Ni) {
  color sum = 0;
  illuminance(Pi, Ni, PI / 2)
    sum += Cl * (normalize(L) . Ni);
  return sum;
}

/* How many free paths from P places of diffusion may be. Of what comes from a plane the rest is below one percent. */
#define SUBSURFACE_PROBE 4

/* How densely rays along one axis find a place: those of diffusionplace(), spread on the plane across the axis, on a surface that is turned
 * from that plane. offset: from P to the place.
 */
float densityalong(vector axis; vector offset; normal Nu; color freepath) {
  return diffusiondensity(length(offset - (offset . axis) * axis), freepath) * abs(Nu . axis);
}

/* Diffusion of all lights: rays find places of the surface round P, where the light is that of their own, then the dipole brings it to P.
 * Three quarters of the rays go along the normal, the others along two axes across it, so that edges and sides that the normal's rays hardly
 * meet are found as well; each place counts by how densely all of them together find it (King, Kulla, Conty, Fajardo, "BSSRDF Importance
 * Sampling", 2013). `map`: "", or a texture that is the albedo at each place (times `albedo`), looked up at its primitive's s and t.
 */
color diffusionscattering(point P; normal Nn; color albedo; color freepath; float eta; uniform float samples; uniform string subset;
                          uniform string map) {
  float reach = max(comp(freepath, 0), comp(freepath, 1), comp(freepath, 2));
  vector base1 = axisacross(vector Nn), base2 = base1 ^ Nn;
  float turn = 2 * PI * random(), colour = floor(3 * random());
  uniform float across = samples < 3 ? 0 : max(1, floor(samples / 8)), i;
  uniform float along = samples - 2 * across;
  color sum = 0;
  for (i = 0; i < samples; i += 1) {
    uniform float way = i < along ? 0 : i < along + across ? 1 : 2;
    uniform float first = way == 0 ? 0 : way == 1 ? along : along + across;
    vector axis = way == 0 ? vector Nn : way == 1 ? base1 : base2;
    float r = 0;
    vector aside = diffusionplace(i - first, way == 0 ? along : across, freepath, colour, turn, way == 0 ? base1 : vector Nn,
                                  way == 2 ? base1 : base2, r);
    float probe = SUBSURFACE_PROBE * reach;
    point Pi = 0;
    normal Ni = 0;
    float si = 0, ti = 0;
    color added = 0;
    traverse("", P + aside + probe * axis, -axis, "primitive:P", Pi, "primitive:N", Ni, "primitive:s", si, "primitive:t", ti, "bias", 0,
             "maxdist", 2 * probe, "subset", subset) {
      normal Nu = normalize(Ni);
      vector offset = Pi - P;
      color there = albedo;
      if (map != "") there *= color texture(map, si, ti, si, ti, si, ti, si, ti, "samples", 1);
      float density = along * densityalong(vector Nn, offset, Nu, freepath) + across * densityalong(base1, offset, Nu, freepath) +
                      across * densityalong(base2, offset, Nu, freepath);
      /* In a ball, all of which rays along any axis reach: beyond it some would, and what they find would weigh far too much. */
      if (length(offset) < probe && density > 0) added += lightat(Pi, Nu) * dipoleof(length(offset), there, freepath, eta) / density;
    }
    sum += added;
  }
  return sum;
}

/* How far beside its place a lookup in a map is, in s and t: by chance within a disc of this width, a part of the map as shadow()'s "blur". A
 * light that is no point shows so what its map, made from one place, has sharp.
 */
vector besideinmap(uniform float blur) {
  vector aside = 0;
  if (blur > 0) {
    float r = 0.5 * blur * sqrt(random()), angle = 2 * PI * random();
    aside = r * vector (cos(angle), sin(angle), 0);
  }
  return aside;
}

/* The nearest place towards a light, by its shadow map: where light to p enters. False (0): the map shows nothing there. The light's camera
 * may be of either projection; the map holds the translucent object only. aside: of besideinmap(), or 0.
 */
float entrybymap(uniform string map; point p; vector aside; output point Pi) {
  uniform matrix toEye = 1, toScreen = 1;
  textureinfo(map, "viewingmatrix", toEye);
  textureinfo(map, "projectionmatrix", toScreen);
  uniform matrix fromEye = 1 / toEye;
  point seen = transform(toEye, p), onScreen = transform(toScreen, p);
  float s = 0.5 * (1 + xcomp(onScreen)) + xcomp(aside), t = 0.5 * (1 - ycomp(onScreen)) + ycomp(aside);
  float depth = float texture(map, s, t, s, t, s, t, s, t, "samples", 1);
  if (comp(toScreen, 3, 3) == 1) /* orthographic */
    setzcomp(seen, depth);
  else
    seen *= depth / zcomp(seen);
  Pi = transform(fromEye, seen);
  return s >= 0 && s <= 1 && t >= 0 && t <= 1 && depth > 0 && depth < 1e29 ? 1 : 0;
}

/* A normal from a picture of normals in the camera space of a light, made with its shadow map. */
normal normalbymap(uniform string map; uniform string normals; point p; vector aside) {
  uniform matrix toEye = 1, toScreen = 1;
  textureinfo(map, "viewingmatrix", toEye);
  textureinfo(map, "projectionmatrix", toScreen);
  point onScreen = transform(toScreen, p);
  float s = 0.5 * (1 + xcomp(onScreen)) + xcomp(aside), t = 0.5 * (1 - ycomp(onScreen)) + ycomp(aside);
  color c = color texture(normals, s, t, s, t, s, t, s, t, "samples", 1);
  return normalize(ntransform(1 / toEye, normal (comp(c, 0), comp(c, 1), comp(c, 2))));
}

/* The part of light from Pi to p that things inside let through, by a map of them from the same light ("": nothing is inside). Where they lie
 * between by `soft` or more nothing gets through.
 */
float pastblockers(uniform string inner; point p; vector aside; float soft) {
  float through = 1;
  if (inner != "") {
    uniform matrix toEye = 1;
    textureinfo(inner, "viewingmatrix", toEye);
    point at = 0;
    if (entrybymap(inner, p, aside, at) == 1)
      through = 1 - smoothstep(0, soft, zcomp(transform(toEye, p)) - zcomp(transform(toEye, at)));
  }
  return through;
}

/* The part of a light that other things leave to P, by a shadow map of them alone ("": nothing is in the way): the maps of the functions below
 * hold the translucent object, whose places are where its depths are, and cannot show what casts shadows on it. For a loop over lights:
 * `sum += Cl * pastothers(outer, P) * diffusionscatteringbymap(...)`.
 */
float pastothers(uniform string outer; point P) {
  float through = 1;
  if (outer != "") through = 1 - float shadow(outer, P);
  return through;
}

/* As singlescattering(), by the light's shadow map. normals: a picture of normals from the light, "": the light enters straight. inner, soft:
 * as for pastblockers(). blur: of all maps, as for besideinmap(); 0: of a point.
 */
color singlescatteringbymap(point P; normal Nn; vector In; vector L; color sigma_a; color sigma_s; float g; float eta;
                            uniform float samples; uniform string map; uniform string normals; uniform string inner; float soft;
                            uniform float blur) {
  vector toLight = normalize(L), To = normalize(refract(In, vector Nn, 1 / eta));
  float turn = floor(3 * random()), i;
  color sum = 0;
  for (i = 0; i < samples; i += 1) {
    float after = turningdepth(i, samples, turn, sigma_a + sigma_s);
    point place = P + after * To, Pi = 0;
    vector aside = besideinmap(blur);
    if (entrybymap(map, place, aside, Pi) == 1) {
      normal Ni = normal toLight;
      if (normals != "") Ni = normalbymap(map, normals, place, aside);
      /* Behind its own entry by rounding only: the light does not go in. */
      float before = max((Pi - place) . toLight, 0);
      sum += pastblockers(inner, place, aside, soft) * turnedonce(To, toLight, Ni, before, after, sigma_a, sigma_s, g, eta);
    }
  }
  return PI * sum / samples;
}

/* Diffusion of one light by its shadow map, for a loop over lights: `sum += Cl * diffusionscatteringbymap(...)`. Samples lie in a plane
 * across the light and go to the surface along it, so that the cosine of the light is in how they spread: the loop has none. inner, soft,
 * blur: as above.
 */
color diffusionscatteringbymap(point P; vector L; color albedo; color freepath; float eta; uniform float samples; uniform string map;
                               uniform string inner; float soft; uniform float blur) {
  vector toLight = normalize(L);
  vector base1 = axisacross(toLight), base2 = base1 ^ toLight;
  float turn = 2 * PI * random(), first = floor(3 * random());
  uniform float i;
  color sum = 0;
  for (i = 0; i < samples; i += 1) {
    float r = 0;
    point place = P + diffusionplace(i, samples, freepath, first, turn, base1, base2, r), Pi = 0;
    vector aside = besideinmap(blur);
    if (entrybymap(map, place, aside, Pi) == 1)
      sum += pastblockers(inner, place, aside, soft) * dipoleof(distance(P, Pi), albedo, freepath, eta) / diffusiondensity(r, freepath);
  }
  return sum / samples;
}

#endif
