/* A surface with an output variable. */
surface tinted(output varying color tint = 0;) {
  tint = color(u, v, 0.5);
  Ci = 0.5 + 0.5 * xcomp(normalize(N));
  Oi = 1;
}
