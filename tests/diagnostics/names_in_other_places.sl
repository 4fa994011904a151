// Names that are known, but not here.
float scaled(float x) { return x * Kd; } // expect-error: unknown variable 'Kd'
float fact(float n) { return n < 2 ? 1 : n * fact(n - 1); } // expect-error: 'fact' calls itself: functions are expanded inline and cannot recur
surface misspelt(float Kd = 1; float rougness = 0.1) {
  normal Nf = faceforward(normalise(N), I); // expect-error: unknown function 'normalise'; did you mean 'normalize'?
  vector V = -normalize(I);
  Ci = Os * Cs * (Kd * difuse(Nf) + kd * specular(Nf, V, roughness)); // expect-error: unknown function 'difuse'; did you mean 'diffuse'? // expect-error: unknown variable 'kd'; did you mean 'Kd'? // expect-error: unknown variable 'roughness'; did you mean 'rougness'?
  Oi = OS + scaled(1) + fact(3) + Color(1, 0, 0); // expect-error: unknown variable 'OS'; did you mean 'Os'? // expect-error: unknown function 'Color'; did you mean 'color'?
}
surface declared_twice(float k = 1; float k = 2) { // expect-error: 'k' is declared twice in the same block
  float x = 1, x = 2; // expect-error: 'x' is declared twice in the same block
  for (x = 0; x < 3; x += 1) { float inner = x; }
  Ci = inner; // expect-error: unknown variable 'inner'
}
surface arrays(float k = 1) {
  float x[k]; // expect-error: the length of array 'x' must be a constant whole number, 1 to 1000000
  float w[3] = 1;
  w = 2; // expect-error: array 'w' cannot be assigned as a whole, only element by element
  w[3] = 1; // expect-error: index 3 is outside array 'w' of 3 elements
  w[-1] = 2; // expect-error: index -1 is outside array 'w' of 3 elements
  w["a"] = 1; // expect-error: a string cannot be used where a float is needed
  Ci = w * 2 + x; // expect-error: operator '*' cannot take (float[3], float); arrays are used element by element
}
surface headers(float k = 1) {
  Ci = snoise(P) * filterwidth(s); // expect-error: there is no function 'snoise': #include "noises.h" brings it // expect-error: #include "filterwidth.h" brings it
  Ci += pulse(0, k, s, t); // expect-error: #include "patterns.h" brings it
}
struct Hit { float distance; color c; }; // expect-error: 'struct' belongs to RSL 2.0, which is not supported
surface structs(float k = 1) {
  Hit h;
  h.distance = k;
  Ci = h.c;
}
