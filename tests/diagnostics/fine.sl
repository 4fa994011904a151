// A program without a single message, with all warnings on.
#pragma annotation "author" "nobody"
float hexgrid(float x, y; float side)
{
  float l(float a, float b) { return sqrt(a * a + b * b); }
  extern point P;
  return min(l(mod(x, 1), y), l(x - 1, y), side) * length(vector P);
}
surface fine(float Ka = 1, Kd = .5; point from = point "shader" (0, 0, 1);
             color tint = color "hsv" (.5, 1, 1); string map = "" ".tex";
             float weights[3] = {1, 2, 3};)
{
  /* comments */ normal Nf = faceforward(normalize(N), I); // of both kinds
  vector toward = normalize(from - P), bent = (1, 1, 0);
  bent *= (1, 1, 0);
  uniform float i;
  float sum = 0, kr, kt;
  for (i = 0; i < 3; i += 1) sum += weights[i];
  fresnel(normalize(I), Nf, 1.5, kr, kt);
  illuminance("key", P, Nf, PI / 2, "lightcache", "refresh") {
    float weight = 0;
    if (lightsource("__nonspecular", weight) != 0) sum += weight;
    Ci += Cl * (normalize(L).Nf);
  }
  color seen = 0;
  float distance = 0, hits = 0;
  gather("", P, toward, 0, 4, "surface:Ci", seen, "ray:length", distance) { hits += 1; } else { break; }
  matrix m = matrix "world" 1;
  Ci += tint * (Ka * ambient() + Kd * diffuse(Nf)) * texture(map[1], s, t, "blur", .1) * noise(P);
  Ci += seen * distance * hits * determinant(m) * hexgrid(s, t, sum) + kr * kt + color(length(bent));
  Oi = Ci = sum > 2 && !(s < .5) ? Os : 1;
}
