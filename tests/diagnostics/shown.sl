// What the messages look like: carets, notes and fixes.
#define SIZE 10;
#define HALF(a) ((a) * hlaf)
float lit(float x) { return x * Kd; } // expect-error: unknown variable 'Kd'
surface shown(float Kd = 1 float half = 0.5; string map = 'a.tex') // expect-error: ',' or ';' // expect-error: quotes
{
  float x = max(Kd, min(s, t); // expect-error: expected ')' or ','
  color c = texture(s, t, map); // expect-error: no 'texture' takes
  c = specular(0.1, N, -I); // expect-error: no 'specular' takes
  c = smothstep(0, 1, s) // expect-error: unknown function // expect-error: expected ';'
  if (x = 2) Ci = N.y; // expect-warning: this assigns // expect-error: no members
  elsif (x > 1) x++; // expect-error: no 'elsif' // expect-error: no operator '++'
  Oi = x[0] + lit(x) * HALF(c); // expect-error: 'x' is no array // expect-error: unknown variable 'hlaf'
  Ci = SIZE * 2; // expect-error: expected an expression
}
