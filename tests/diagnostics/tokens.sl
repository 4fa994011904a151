// Characters, numbers and strings.
surface s(float k = 1; string name = "")
{
  float a = 1.5f; // expect-warning: the suffix of '1.5f' is ignored
  float b = 0x1f; // expect-error: no hexadecimal numbers
  float c = 0s; // expect-error: '0s' is not a number
  float d = 1e99; // expect-warning: does not fit a float
  float e = a @ b; // expect-error: '@' has no meaning
  float é = 1; // expect-error: a character outside ASCII
  a = a + +b; // expect-warning: '+' sign has no effect
  a = a % b; // expect-error: no operator '%': write mod(a, b)
  string t = "a\qb"; // expect-warning: unknown escape '\q'
  string u = "open; // expect-error: does not end on this line
#pragma nonsense // expect-warning: #pragma nonsense is not known here
#pragma annotation "only one" // expect-warning: needs two strings
}
