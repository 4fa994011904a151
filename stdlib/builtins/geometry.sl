/* Built-in functions written in the language: directions and coordinate systems (RISpec 3.2, 15.2). How these bodies
 * are found: mathematics.sl. Matrices are made by the internal row spacematrix(from, to), once for a grid.
 */

vector faceforward(vector N; vector I) {
  extern normal Ng;
  return faceforward(N, I, vector Ng);
}

point transform(uniform string to; point p) {
  return transform(spacematrix("current", to), p);
}
point transform(uniform string from; uniform string to; point p) {
  return transform(spacematrix(from, to), p);
}
point transform(uniform string from; matrix m; point p) {
  return transform(m, p);
}

/* A perspective space has no one matrix for directions: there the image of v is taken at P. */
vector vtransform(uniform string from; uniform string to; vector v) {
  uniform matrix m = spacematrix(from, to);
  vector result = vtransform(m, v);
  if (isperspective(m) != 0) {
    result = projectvector(from, to, v);
  }
  return result;
}
vector vtransform(uniform string to; vector v) {
  return vtransform("current", to, v);
}
vector vtransform(uniform string from; matrix m; vector v) {
  return vtransform(m, v);
}

normal ntransform(matrix m; normal n) {
  return normal vtransform(normalmatrix(m), vector n);
}
normal ntransform(uniform string to; normal n) {
  return ntransform(spacematrix("current", to), n);
}
normal ntransform(uniform string from; uniform string to; normal n) {
  return ntransform(spacematrix(from, to), n);
}
normal ntransform(uniform string from; matrix m; normal n) {
  return ntransform(m, n);
}

matrix mtransform(uniform string to; matrix m) {
  return spacematrix(to, "current") * m;
}
matrix mtransform(uniform string from; uniform string to; matrix m) {
  return spacematrix(to, from) * m;
}

float depth(point p) {
  uniform float clipping[2] = {0, 1};
  option("Clipping", clipping);
  float z = zcomp(transform("camera", p));
  return (z - clipping[0]) / (clipping[1] - clipping[0]);
}

/* One-sided surfaces keep their side, but only for the camera: rays may come from anywhere. */
normal shadingnormal(normal N) {
  extern vector I;
  normal Nn = normalize(N);
  uniform float sides = 2;
  attribute("Sides", sides);
  if (sides == 2 || raydepth() > 0) Nn = normal faceforward(vector Nn, I, vector Nn);
  return Nn;
}
