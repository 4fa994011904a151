/* raysphere.h: where a ray meets a sphere.
 */
#ifndef ANEMONE_RAYSPHERE_H
#define ANEMONE_RAYSPHERE_H

/* The ray from E along the unit vector I, the sphere of radius r about the origin. Returns how many hits lie farther than
 * eps, and their distances t0 <= t1.
 */
float raysphere(point E; vector I; float r; float eps; output float t0; output float t1) {
  /* |E + t I|^2 = r^2: t^2 + 2 b t + c = 0 */
  float b = vector E . I, c = vector E . vector E - r * r;
  float discriminant = b * b - c, hits = 0;
  t0 = 0;
  t1 = 0;
  if (discriminant > 0) {
    float root = sqrt(discriminant);
    t0 = -b - root;
    t1 = -b + root;
    if (t0 > eps) {
      hits = 2;
    } else if (t1 > eps) {
      hits = 1;
      t0 = t1;
    }
  }
  return hits;
}

#endif
