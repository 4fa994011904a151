// Results and calls of functions.
omitted(float x) { return x; } // expect-warning: no result type; float is assumed
float nothing(float x) { } // expect-error: has no return statement
void gives(float x) { return x; } // expect-error: void function 'gives' cannot return a value
float wants(float x) { if (x > 0) return; return 1; } // expect-error: must return a float
string text() { return 1; } // expect-error: a float cannot become the string that 'text' returns
float pick(vector v) { return 1; }
float pick(normal n) { return 2; }
void store(output float x) { x = 1; }
void keep(float x) { x = 1; } // expect-warning: formal 'x' is read-only: a copy is changed. Declare it 'output' if the caller should see the change
void fill(float x[]) { x[0] = 1; } // expect-error: formal array 'x' is read-only: declare it 'output'
surface s(float k = 1)
{
  float f = pick(P); // expect-error: the call of 'pick' is ambiguous // expect-warning: a point is used as a vector
  f = sqrt(1, 2); // expect-error: no 'sqrt' takes 2 arguments
  f = smoothstep(Cs, 0.2, 0.8); // expect-error: no 'smoothstep' takes (color, float, float)
  store(1 + f); // expect-error: only a variable or an array element can receive it
  store(k); // expect-warning: parameter 'k' is read-only: a copy is changed. Declare it 'output' if others should see the change
  k = 2;
  f = store(f); // expect-error: the function returns nothing
  printf("%f", store(f)); // expect-error: returns nothing is used as a value // expect-error: cannot print a void
  f = diffuse("a"[1]); // expect-error: 'diffuse' takes no channel // expect-error: no 'diffuse' takes (string)
  return 3; // expect-error: a shader returns no value
}
