// What compiles and may still be wrong.
surface s(float k = 1; float unused = 2; string pattern = "%f") // expect-warning: parameter 'unused' is not used
{
  float never = 1; // expect-warning: is set but never read
  float nothing; // expect-warning: 'nothing' is not used
  float early;
  float f = early; // expect-warning: read before it is set
  early = 1;
  if (k) f += 1; // expect-warning: a float used as condition
  if (f = k) f += 1; // expect-warning: this assigns
  f = k > 2; // expect-warning: a relation used as a number
  f + 1; // expect-warning: the value of this expression is not used
  point both = P + P; // expect-warning: the sum of two points
  vector v = P; // expect-warning: a point is used as a vector
  f += float texture("a.tex", "blurr", 0.1); // expect-warning: did you mean "blur"?
  f += float texture("a.tex", "nonsense", 0.1); // expect-warning: no optional argument "nonsense"
  gather("", P, N, 0, 1, "light:Cl", Ci) { f += 1; } // expect-warning: rays hit surfaces, not lights; let the surface keep what its light loop finds in an output parameter, and ask for that by "surface:NAME". It is ignored
  traverse("", P, N, "surfce:Ci", Ci) { f += 1; } // expect-warning: no optional argument "surfce:Ci"; did you mean "surface:Ci"?
  f += float trace(P, N, "axis", N); // expect-warning: 'trace' has no optional argument "axis": rays go about the direction that the call says. It is ignored
  f += float transmission(P, E, "brightnesswarp", 0); // expect-warning: directions as the light of a map comes are had from gather, with "distribution" and the map's name. It is ignored
  f += occlusion(P, N, 16, "hitmode", "shader"); // expect-warning: 'occlusion' has no optional argument "hitmode": what is there blocks, whatever its opacity, and no shader runs. It is ignored
  f += occlusion(P, N, 16, "gridcontrol", 1); // expect-warning: Attribute "irradiance" "maxerror" and "maxpixeldist" say where rays are shot. It is ignored
  gather("", P, N, 0, 1, "adaptive", 0) { f += 1; } // expect-warning: 'gather' has no optional argument "adaptive": all rays are shot. It is ignored
  Ci = color "hsb" (f, 0, 0); // expect-warning: no color space "hsb"
  point p = transform("wold", both); // expect-warning: did you mean "world"?
  point q = transform("object", P);
  q = transform("world", q); // expect-warning: is in space "object" already
  printf(pattern, noise(P)); // expect-warning: nothing says which type 'noise' should return
  Ci = f + xcomp(p) + length(v) + xcomp(q) + Ci;
}
