/* cubicprojection.h: texture coordinates for any shape, by projection on the sides of a cube.
 *
 * p and n are a point and a normal of the undisplaced surface in the space of the cube; n may have any length. The side of the cube that n
 * points to most decides. Unlike a plain cubic projection, each side has its own offset, so that opposite sides do not show
 * the same texture, and lookups may be blended over the edges.
 */
#ifndef ANEMONE_CUBICPROJECTION_H
#define ANEMONE_CUBICPROJECTION_H

/* The side n points to: 0 and 1 for x (up and down), 2 and 3 for y, 4 and 5 for z. */
float cubicside(vector n) {
  float x = abs(xcomp(n)), y = abs(ycomp(n)), z = abs(zcomp(n));
  float side, sign_of;
  if (x >= y && x >= z) {
    side = 0;
    sign_of = xcomp(n);
  } else if (y >= z) {
    side = 2;
    sign_of = ycomp(n);
  } else {
    side = 4;
    sign_of = zcomp(n);
  }
  return sign_of < 0 ? side + 1 : side;
}

/* Coordinates on one side; offsets between sides are no multiples of a period. */
void cubiccoordinates(point p; float side; output float ss; output float tt) {
  float axis = floor(side / 2);
  if (axis == 0) {
    ss = ycomp(p);
    tt = zcomp(p);
  } else if (axis == 1) {
    ss = zcomp(p);
    tt = xcomp(p);
  } else {
    ss = xcomp(p);
    tt = ycomp(p);
  }
  ss += 0.37 * side;
  tt += 0.59 * side;
}

/* The coordinates of the side n points to. */
void cubicprojection(point p; vector n; output float ss; output float tt) {
  cubiccoordinates(p, cubicside(n), ss, tt);
}

/* Weights of the three axes, which add up to 1: one axis alone where n is farther than blend (0 to 1) from an edge of the cube. */
void cubicweights(vector n; float blend; output float wx; output float wy; output float wz) {
  float x = abs(xcomp(n)), y = abs(ycomp(n)), z = abs(zcomp(n));
  float most = max(x, y, z);
  float from = 1 - max(blend, 1e-3);
  wx = smoothstep(from, 1, x / most);
  wy = smoothstep(from, 1, y / most);
  wz = smoothstep(from, 1, z / most);
  float sum = wx + wy + wz;
  wx /= sum;
  wy /= sum;
  wz /= sum;
}

/* One channel of a texture that repeats, laid on by the projection; sides that do not show are not looked up. "" gives 0. */
float cubictexture(string map; uniform float channel; point p; vector n; float blend; float blur) {
  float sum = 0;
  if (map != "") {
    float wx, wy, wz, ss, tt;
    cubicweights(n, blend, wx, wy, wz);
    if (wx > 0) {
      cubiccoordinates(p, xcomp(n) < 0 ? 1 : 0, ss, tt);
      sum += wx * float texture(map[channel], ss, tt, "blur", blur);
    }
    if (wy > 0) {
      cubiccoordinates(p, ycomp(n) < 0 ? 3 : 2, ss, tt);
      sum += wy * float texture(map[channel], ss, tt, "blur", blur);
    }
    if (wz > 0) {
      cubiccoordinates(p, zcomp(n) < 0 ? 5 : 4, ss, tt);
      sum += wz * float texture(map[channel], ss, tt, "blur", blur);
    }
  }
  return sum;
}

#endif
