// Optional arguments, patterns, statements with arguments.
surface s(float k = 1; string token = "blur")
{
  float f = 0;
  color c = 0;
  f = float texture("a.tex", "blur"); // expect-error: no 'texture' takes 2 arguments
  gather("", P, N, 0, 4, "surface:Ci") f += 1; // expect-error: has no value behind it
  gather("", P, N, 0, 4, f, c) f += 1; // expect-error: expected the name of an optional argument of 'gather'
  gather("", P, N, 0) f += 1; // expect-error: gather takes
  traverse("", P) f += 1; // expect-error: traverse takes
  gather("", P, N, 0, 4, "ray:length", c) f += 1; // expect-error: "ray:length" sets a float, not a color
  gather("", P, N, 0, 4, "ray:length", 2) f += 1; // expect-error: can receive it
  illuminance() f += 1; // expect-error: illuminance takes
  illuminance(P, N) f += 1; // expect-error: illuminance takes
  point q = transform(); // expect-error: no 'transform' takes 0 arguments
  printf("%d %q", f, f); // expect-error: '%q' is no conversion
  printf("%d", f, f); // expect-error: the pattern has 1 conversion for 2 values
  printf("%c", f); // expect-error: '%c' cannot print a float
  break; // expect-error: 'break' stands in no loop
  while (f < 10) { f += 1; continue 2; } // expect-error: 'continue 2' leaves 2 loops, but stands in 1 loop
  Ci = c;
}
light l() {
  illuminate(P, N) Cl = 1; // expect-error: illuminate takes
  solar(N) Cl = 1; // expect-error: solar takes
}
