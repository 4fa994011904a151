// One error does not hide the next.
surface one(float k = 1)
{
  float a = 1 // expect-error: expected ';'
  float b = ; // expect-error: expected an expression
  a = (1, 2); // expect-error: 2 values in parentheses
  a + 1 = b; // expect-error: only a variable or an array element
  flaot c = 1; // expect-error: did you mean 'float'?
  else a = 1; // expect-error: belongs to no 'if'
  break 1.5; // expect-error: whole number from 1 // expect-error: 'break' stands in no loop
  return = 3; // expect-error: 'return' is no variable
  uniform d = 1; // expect-error: the type of 'd' is missing
  float 3 = 1; // expect-error: only a variable or an array element
  float color = 1; // expect-error: cannot be a name
  output float e = 1; // expect-error: 'output' does not belong to a local variable
  Ci = a->b; // expect-error: '->' belongs to RSL 2.0
  shader co = 0; // expect-error: 'shader' belongs to RSL 2.0
  if (a > 1) { b = 2;
  // a brace is missing here
}
surface two(extern float k = 1) // expect-error: a '}' is missing before 'surface' // expect-error: 'extern' does not belong to a formal
{
}
} // expect-error: closes nothing
struct Pair { float a; float b; } // expect-error: 'struct' belongs to RSL 2.0
surfice three() {} // expect-error: neither a kind of shader
42; // expect-error: expected a shader or a function, found '42'
float half(float x) { return x / 2; }
surface four(float a, = 1) {} // expect-error: expected a name // expect-warning: needs a default value; 0 is taken
surface five() { Ci = half(0.5); }
