/* displace.h: displacement and bump mapping by one function.
 */
#ifndef ANEMONE_DISPLACE_H
#define ANEMONE_DISPLACE_H

/* Moves P along dir (unit length, "current" space) by amp, a length in the named space, as far as truedisp says: 1
 * displaces, 0 only bends the normal. Sets P and N; the result is the normal of the surface moved all the way.
 */
normal Displace(vector dir; string space; float amp; float truedisp) {
  extern point P;
  extern normal N;
  float unit = length(vtransform(space, dir));
  vector move = dir * (amp / unit);
  normal Nn = normalize(calculatenormal(P + move));
  P += truedisp * move;
  N = normalize(calculatenormal(P));
  return Nn;
}

#endif
