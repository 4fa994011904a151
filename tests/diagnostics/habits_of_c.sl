// What people write who come from C: each habit is one message.
const float EPS = 0.001; // expect-error: 'EPS': there are no variables outside shaders and functions; for a constant write '#define EPS value'
float scale = 2, bias = 0; // expect-error: 'scale': there are no variables outside shaders and functions; for a constant write '#define scale value'
float half(float x); // expect-error: functions need no declaration before their definition: delete this line, and define 'half' above where it is called
float half(float x) { return x / 2; }
float one(void) { return 1; } // expect-error: a function without formals is written with empty parentheses
int count(float x) { return floor(x); } // expect-error: the shading language has no type 'int': all numbers are floats
void swap(float &a, float *b) { float c = a; a = b; b = c; } // expect-error: there are no references and pointers: arguments are passed by reference, and what is declared 'output' can be set // expect-error: there are no references and pointers: arguments are passed by reference, and what is declared 'output' can be set
float first(float[3] list) { return list[0]; } // expect-error: the length of an array stands behind its name: float name[length]
surface types(int n = 4; double k = 1; const float c = 2; float[3] list = {1, 2, 3}; bool on = true) // expect-error: the shading language has no type 'int': all numbers are floats // expect-error: the shading language has no type 'double': all numbers are floats // expect-error: the shading language has no 'const': leave it out, or write #define for a constant // expect-error: the length of an array stands behind its name: float name[length] // expect-error: the shading language has no type 'bool': use a float, 0 or 1 // expect-error: there is no variable 'true': write 1
{
  int i; // expect-error: the shading language has no type 'int': all numbers are floats
  unsigned j = 0; // expect-error: the shading language has no type 'unsigned': all numbers are floats
  bool flag = true, other = FALSE; // expect-error: the shading language has no type 'bool': use a float, 0 or 1 // expect-error: there is no variable 'true': write 1 // expect-error: there is no variable 'FALSE': write 0
  char text = 'wood'; // expect-error: the shading language has no type 'char': texts are strings // expect-error: strings stand in double quotes
  float[2] pair = {1, 2}; // expect-error: the length of an array stands behind its name: float name[length]
  static float calls = 0; // expect-error: the shading language has no 'static': leave it out, nothing is kept from one run to the next
  float table[2][2]; // expect-error: arrays have one index: there are no arrays of arrays, and elements of a matrix are comp(m, row, column)
  float hexadecimal = 0xff, decimal = 1.0f, none = NULL; // expect-error: '0xff': there are no hexadecimal numbers in the shading language // expect-warning: the suffix of '1.0f' is ignored: all numbers are floats // expect-error: there is no variable 'NULL': nothing is null; the empty string is ""
  for (int m = 0; m < n; m++) Ci += Cs / n; // expect-error: the shading language has no type 'int': all numbers are floats // expect-error: the shading language has no operator '++': write x += 1
  calls++; // expect-error: the shading language has no operator '++': write x += 1
  --calls; // expect-error: the shading language has no operator '--': write x -= 1
  if (flag == false) Ci = EPS * scale + bias + pair[0] + first(list) + table[0][1]; // expect-error: there is no variable 'false': write 0 // expect-error: arrays have one index: there are no arrays of arrays, and elements of a matrix are comp(m, row, column)
  swap(&calls, k); // expect-error: there are no references and pointers: arguments are passed by reference, and what is declared 'output' can be set // expect-warning: parameter 'k' is read-only
  Ci = half(one()) + count(i) + j + text[0]; // expect-error: 'text' is no array
}
surface operators(float k = 1; color tint = 1)
{
  float i = floor(s * 10), x = i % 2; // expect-error: the shading language has no operator '%': write mod(a, b)
  if (i % 2 == 0) x = 1; else x = 0; // expect-error: the shading language has no operator '%': write mod(a, b)
  i %= 3; // expect-error: the shading language has no operator '%=': write x = mod(x, y)
  x = 1 << 2; // expect-error: the shading language has no operator '<<': there are no bit operations
  x = i & 1; // expect-error: the shading language has no operator '&': logical 'and' is &&, and there are no bit operations
  if (k > 1 | k < 2) x = ~i; // expect-error: the shading language has no operator '|': logical 'or' is ||, and there are no bit operations // expect-error: the shading language has no operator '~': there are no bit operations
  if (tint && Cs) x = 1; // expect-error: a color is no condition: compare it with something // expect-error: a color is no condition: compare it with something
  if (!tint) x = 2; // expect-error: operator '!' cannot take (color); compare it with something
  if (P) x = 1; // expect-error: a point is no condition: compare it with something
  if (0 < k < 1) x = 1; // expect-warning: this compares the 1 or 0 of the first comparison; a double one is written: a < b && b < c
  x = N->y; // expect-error: '->' belongs to RSL 2.0, which is not supported; components are xcomp(v), ycomp(v), zcomp(v) and comp(c, i)
  x = k ^ 2; // expect-error: operator '^' cannot take (float, float); '^' is the cross product of vectors: for a power write pow(x, y)
  Ci = x ^= 2; // expect-error: the shading language has no operator '^=': write x = x ^ y
}
surface statements(float k = 1)
{
  switch (k) { // expect-error: the shading language has no 'switch': write if ... else if ...
  case 0: Ci = 1; break;
  default: Ci = 2;
  }
  do { Ci += 1; } while (k < 0); // expect-error: the shading language has no 'do': write while (condition) ..., or while (1 > 0) { ... if (...) break; }
  goto end; // expect-error: the shading language has no 'goto': loops are left by break, functions by return
  return k; // expect-error: a shader returns no value: assign to its output variables
}
