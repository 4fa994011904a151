/* axisacross.h: directions square to a given one. */
#ifndef ANEMONE_AXISACROSS_H
#define ANEMONE_AXISACROSS_H

/* A unit vector across one of unit length. */
vector axisacross(vector along) {
  return normalize(along ^ (abs(xcomp(along)) > 0.7 ? vector (0, 1, 0) : vector (1, 0, 0)));
}

#endif
