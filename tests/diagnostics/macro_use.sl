// Errors in a macro's body are shown where it is used.
#define SQUARE(a) ((a) * (a))
#define BAD undeclared_in_body
surface s(float k = 1;) {
  Ci = Cs * SQUARE("text"); // expect-error: operator '*' cannot take (string, string)
  Ci = Ci * BAD; // expect-error: unknown variable 'undeclared_in_body'
  Ci = Ci * SQUARE(undeclared_argument); // expect-error: unknown variable 'undeclared_argument' // expect-error: unknown variable 'undeclared_argument'
}
