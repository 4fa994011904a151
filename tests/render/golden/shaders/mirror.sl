/* Reflects an environment map in world space. */
surface mirror(string map = "";) {
  normal Nf = faceforward(normalize(N), I);
  vector R = vtransform("world", reflect(normalize(I), Nf));
  Ci = color environment(map, R);
  Oi = 1;
}
