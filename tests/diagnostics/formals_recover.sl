// A bad formal does not spoil the rest of the file.
surface one(float a = 1; flt b = 2; // expect-error: expected a type, found 'flt'
            float c = 3)
{
  Ci = c; // expect-error: unknown variable 'c'
}
surface two(float a = 1;) { Ci = a; }
