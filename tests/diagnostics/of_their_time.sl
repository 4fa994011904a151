// What shaders of the nineties and 2000s are full of, and compilers of their time took.
#include "no_newline.h"
#ifndef OF_THEIR_TIME
#define OF_THEIR_TIME 1
#endif OF_THEIR_TIME
doubled(float x) { return 2 * x; } // expect-warning: has no result type; float is assumed
surface names(float incident = 1; float light = 2, class = 3; uniform float shader = 4;) {
  float gather = 6, public = 7, solar = 8, traverse = 9, struct = 10, method = 11, plugin = 12;
  float occlusion = incident + light + class + shader + gather + public + solar + traverse + struct + method + plugin;
  Ci = occlusion + doubled(from_header(1));
};
surface dots() {
  vector V = -I;
  float a = V.normalize(N), b = N.I, c = .5;
  Ci = a + b + c;
}
surface casts() {
  color arr[3] = {1, 2, 3};
  float i = 1;
  color c = color arr[i] + color -1;
  vector v = vector -I;
  float n = float -noise(P);
  Ci = c + color v + n;
}
surface maps(string map = ""; string maps[2] = {"", ""}) {
  float a = shadow(map, P), b = float environment(map, N), c = float shadow(map[0], P), d = environment(map[1], N);
  color e = texture(map), f = texture(maps[1], s, t), g = environment(map, N) * shadow(map, P);
  Ci = pow(e + f + g, 2) + pow(color (1, 2, 3), color (3, 2, 1)) + a + b + c + d;
}
surface hiding() {
  float mix(float a) { return 2 * a; }
  float noise = 3;
  Ci = mix(noise) + float noise(P);
}
surface uniforms() {
  uniform float fine = noise(3);
  uniform float sometimes = 0;
  if (u > 0.5) sometimes = 1; // expect-warning: is varying from here
  Ci = fine + sometimes;
}
surface lengths(float list[] = {1, 2, 3}) {
  float own[] = {1, 2};
  Ci = list[1] + own[1];
}
surface defaults(float a; string b; color c[2]; float d = 1) { // expect-warning: parameter 'a' of shader 'defaults' needs a default value; 0 is taken // expect-warning: needs a default value; "" is taken // expect-warning: parameter 'c'
  float unset;
  Ci = a * c[0] + d + unset; // expect-warning: read before it is set
  if (b == "") Ci *= 2;
}
light ambience(float intensity = 1) {
  L = 0; // expect-warning: 'L' is what illuminate and solar give: set here it has no effect
  N = normalize(N); // expect-warning: 'N' is read-only in light shaders
  Cl = intensity * length(N);
}
#define sqr(x) ((x) * (x))
float with_a_function_named_like_a_macro(float x) {
  float sqr (float y) { return y * y; }
  return sqr(x);
}
surface draws() {
  uniform color once = color(random(), random(), with_a_function_named_like_a_macro(random()));
  Ci = once;
}
imager film() { Ci *= noise(s, t); }
