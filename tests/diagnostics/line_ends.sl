// What is missing at the end of a line is shown there.
surface checker(float freq = 10 // expect-error: expected ',' or ';', found 'float'
                float width = 1)
{
  float check;
  if (s > 0.5 && t > width // expect-error: expected ')', found 'check'
    check = 1;
  else
    check = 0;
  Ci = mix(Cs, 1, check // expect-error: expected ')' or ',', found 'Oi'
  Oi = Os;
  illuminance(P, normalize(N), PI / 2 // expect-error: expected ')' or ',', found 'Ci'
    Ci += Cl * freq;
}
