/* project.h: texture coordinates by projection, and textures laid over a colour or value.
 *
 * Projections: "st" takes the surface's s and t; "planar" x and y; "perspective" x/z and y/z; "spherical" longitude, 0
 * to 1, and latitude, -0.5 to 0.5; "cylindrical" longitude and height. Points are taken to whichspace and transformed by xform first.
 */
#ifndef ANEMONE_PROJECT_H
#define ANEMONE_PROJECT_H

#include "filterwidth.h"

/* Filter width of a coordinate that jumps from 1 to 0: the smaller of its own and that of the coordinate half a turn on. */
float wrappedwidth(float x) {
  return min(filterwidth(x), filterwidth(mod(x + 0.5, 1)));
}

void spherical_projection(point p; output float ss; output float tt; output float ds; output float dt) {
  vector direction = normalize(vector p);
  ss = 0.5 - atan(ycomp(direction), xcomp(direction)) / (2 * PI);
  tt = 0.5 - acos(zcomp(direction)) / PI;
  ds = wrappedwidth(ss);
  dt = filterwidth(tt);
}

void cylindrical_projection(point p; output float ss; output float tt; output float ds; output float dt) {
  ss = 0.5 - atan(ycomp(p), xcomp(p)) / (2 * PI);
  tt = zcomp(p);
  ds = wrappedwidth(ss);
  dt = filterwidth(tt);
}

void ProjectTo2D(string projection; point P; string whichspace; matrix xform; output float ss; output float tt;
                 output float ds; output float dt) {
  point p;
  if (projection == "st") {
    extern float s, t;
    p = point (s, t, 0);
  } else {
    p = transform(whichspace, P);
  }
  p = transform(xform, p);
  if (projection == "spherical") {
    spherical_projection(p, ss, tt, ds, dt);
  } else if (projection == "cylindrical") {
    cylindrical_projection(p, ss, tt, ds, dt);
  } else {
    float z = projection == "perspective" ? max(zcomp(p), 1e-6) : 1;
    ss = xcomp(p) / z;
    tt = ycomp(p) / z;
    ds = filterwidth(ss);
    dt = filterwidth(tt);
  }
}

/* The texture and its opacity, channel alphachannel (1 where the file has none). */
color GetColorTextureAndAlpha(string texturename; string projection; point P; string whichspace; matrix xform;
                              float blur; uniform float alphachannel; output float alpha) {
  float ss, tt, ds, dt;
  ProjectTo2D(projection, P, whichspace, xform, ss, tt, ds, dt);
  float s0 = ss - 0.5 * ds, s1 = ss + 0.5 * ds, t0 = tt - 0.5 * dt, t1 = tt + 0.5 * dt;
  alpha = float texture(texturename[alphachannel], s0, t0, s1, t0, s0, t1, s1, t1, "blur", blur, "fill", 1);
  return color texture(texturename, s0, t0, s1, t0, s0, t1, s1, t1, "blur", blur);
}
float GetFloatTextureAndAlpha(string texturename; string projection; point P; string whichspace; matrix xform;
                              float blur; uniform float alphachannel; output float alpha) {
  float ss, tt, ds, dt;
  ProjectTo2D(projection, P, whichspace, xform, ss, tt, ds, dt);
  float s0 = ss - 0.5 * ds, s1 = ss + 0.5 * ds, t0 = tt - 0.5 * dt, t1 = tt + 0.5 * dt;
  alpha = float texture(texturename[alphachannel], s0, t0, s1, t0, s0, t1, s1, t1, "blur", blur, "fill", 1);
  return float texture(texturename, s0, t0, s1, t0, s0, t1, s1, t1, "blur", blur);
}

/* The texture over what is there; a texture without name changes nothing. */
color ApplyColorTextureOver(color basecolor; string texturename; string projection; point P; string whichspace;
                            matrix xform; float blur) {
  color result = basecolor;
  if (texturename != "") {
    float alpha;
    color layer = GetColorTextureAndAlpha(texturename, projection, P, whichspace, xform, blur, 3, alpha);
    result = layer + (1 - alpha) * basecolor;
  }
  return result;
}
float ApplyFloatTextureOver(float baseval; string texturename; string projection; point P; string whichspace;
                            matrix xform; float blur) {
  float result = baseval;
  if (texturename != "") {
    float alpha;
    float layer = GetFloatTextureAndAlpha(texturename, projection, P, whichspace, xform, blur, 1, alpha);
    result = layer + (1 - alpha) * baseval;
  }
  return result;
}

/* Shader parameters of old could not be matrices. */
matrix array_to_mx(float mx[16]) {
  return matrix (mx[0], mx[1], mx[2], mx[3], mx[4], mx[5], mx[6], mx[7], mx[8], mx[9], mx[10], mx[11], mx[12], mx[13],
                 mx[14], mx[15]);
}

#endif
