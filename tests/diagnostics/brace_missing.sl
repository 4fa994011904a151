// The '}' of a shader closes the 'if' in it.
surface first(float k = 1) {
  if (k > 1) {
    Ci = 1;
  Oi = 1;
}
surface second(float k = 1) { // expect-error: a '}' is missing before 'surface'
  Ci = k;
}
