// Brackets that are missing, or too many.
surface parens(float k = 1) {
  float x = max(k, min(s, t); // expect-error: expected ')' or ',', found ';'
  if (x > 1 { Ci = x; } else Ci = 1; // expect-error: expected ')', found '{'
  Ci = (x + 1; // expect-error: expected ')', found ';'
  x = max(k, 2)); // expect-error: this ')' closes nothing
  if (x > 1)) Ci = 1; // expect-error: this ')' closes nothing
  if x > 1 { Ci = 2; } else { Ci = 3; } // expect-error: expected '(', found 'x'
  for (x = 0; x < 3) Ci += x; // expect-error: expected ';', found ')'
  while (x > 1 x += 1; // expect-error: expected ')', found 'x'
  float a[3] = {1, 2, 3; // expect-error: expected '}', found ';'
  float b[2 = {1, 2}; // expect-error: expected ']', found '=' // expect-error: expected ';', found '}'
  Ci = a[1 + b[0]; // expect-error: expected ']', found ';'
  illuminance P { Ci += Cl; } // expect-error: expected '(', found 'P'
  illuminance(P, N, PI { Ci += Cl; } // expect-error: expected ')' or ',', found '{'
  Oi = 1;
}
