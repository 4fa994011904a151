#define SQ(x) ((x)*(x))
#pragma annotation "help" "a bit of everything"
float twice(float x; output float y) { y = x; return 2 * x; }
surface everything(float Ka = 1, Kd = .5; uniform color tint[2] = {color(1, 0, 0), 1}; string map = ""; output varying color aov = 0;) {
  normal Nf = faceforward(normalize(N), I);
  color diff = 0;
  float i, h = 0;
  illuminance("-fill", P, Nf, PI / 2) { extern float h; diff += Cl * (normalize(L) . Nf); if (h > 2) break; }
  for (i = 0; i < 4; i += 1) { if (mod(i, 2) == 0) continue; h += noise(P * pow(2, i)) / SQ(2); }
  while (h > 1 && h != 0) h /= 2;
  point q = transform("shader", P) + vector "world" (1, 2, 3);
  matrix m = 1;
  printf("%f %p %c\n", h, q, diff);
  aov = mix(tint[0], color "hsv" (h, 1, 1), smoothstep(0, 1, twice(s, h)));
  Ci = h > 0.5 ? aov : Ka * ambient() + Kd * diffuse(Nf);
  Oi = Os; Ci *= Oi;
}
