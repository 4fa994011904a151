// Semicolons that are missing, or too many.
surface missing(float k = 1) {
  float x = k // expect-error: expected ';', found 'color'
  color c = x;
  Ci = c // expect-error: expected ';', found 'if'
  if (x > 1)
    Ci = 2 // expect-error: expected ';', found 'else'
  else
    Ci = 3;
  Oi = Os // expect-error: expected ';', found '}'
}
surface before_body(float k = 1); // expect-error: expected '{', found ';'
{
  Ci = k;
}
float half(float x); // expect-error: expected '{', found ';'
{
  return x / 2;
}
surface behind_condition(float k = 1) {
  if (k > 1); // expect-warning: this ';' is all that the 'if' before it governs
    Ci = 1;
  while (k > 2); { Ci = 2; } // expect-warning: this ';' is all that the 'while' before it governs
  if (k > 1); // expect-warning: this ';' is all that the 'if' before it governs
    Ci = half(k);
  else // expect-error: this 'else' belongs to no 'if': an 'if' ends with the one statement behind it; several stand in braces
    Ci = 2;
}
surface two_before_else(float k = 1) {
  if (k > 1)
    Ci = 1;
    Oi = 1;
  else // expect-error: this 'else' belongs to no 'if': an 'if' ends with the one statement behind it; several stand in braces
    Ci = 0;
}
#define SIZE 10;
#define COUNT = 10
surface in_macros(float k = 1) {
  Ci = SIZE * k; // expect-error: expected an expression, found '*'
  Ci = COUNT * k; // expect-error: expected an expression, found '='
}
