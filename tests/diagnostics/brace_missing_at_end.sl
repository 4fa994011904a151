// The same at the end of the file.
surface only(float k = 1) {
  while (k > 1) {
    Ci = 1;
  Oi = 1;
} // expect-error: a '}' is missing before the end of the file
