// Uniform and varying.
uniform float fixed(float x) { return x; } // expect-error: this one is varying
float half(uniform float x) { return x / 2; }
float counted(float x) {
  uniform float n = 0;
  if (x > 0) n = 1; // expect-warning: set under a varying condition
  return n;
}
surface s(uniform float k = u; // expect-error: varying value cannot be stored in the uniform variable 'k'
          uniform float m = 1; output float out = 0; output varying float fine = 0)
{
  uniform float a = u; // expect-error: cannot be stored in the uniform variable 'a'
  uniform float once = random();
  uniform string name = "a.tex";
  float inferred = m * 2;
  a = half(inferred);
  a = half(s); // expect-error: 'x' of 'half' must be uniform
  a = fixed(m);
  out = s; // expect-error: cannot be stored in the uniform variable 'out'
  fine = pnoise(s, inferred);
  fine += pnoise(s, s); // expect-error: 'period' of 'pnoise' must be uniform
  fine += float texture(name, s, t, "fill", s); // expect-error: the value of "fill" must be uniform
  fine += counted(s) + fixed(s) + once + k;
  string chosen = "a.tex";
  if (s > 0.5) chosen = "b.tex";
  fine += float texture(chosen, s, t, "samples", s); // one lookup for each name and number of samples
  fine += comp(photonmap(chosen, P), 0); // expect-error: 'file' of 'photonmap' must be uniform
  Ci = fine + a;
}
