// A missing quote is one error.
surface one(string map = "wood.tex) { // expect-error: the string does not end on this line
  Ci = texture(map);
}
surface two(float k = 1) {
  Ci = texture("wood.tex, s, t); // expect-error: the string does not end on this line
  printf("hello, world); // expect-error: the string does not end on this line
  Oi = k;
}
