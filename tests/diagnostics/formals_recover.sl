// A bad formal does not spoil the rest of the file.
surface one(float a = 1; flt b = 2; // expect-error: unknown type 'flt'
            float c = 3)
{
  Ci = c; // what follows is known
}
surface two(float a = 1;) { Ci = a; }
