// Names, and where they are known.
float outer(float x) { return x * k; } // expect-error: unknown variable 'k'
float uses_p() { return length(P); } // expect-warning: declare 'extern point P;' // expect-warning: a point is used as a vector
float twice(float x) { return 2 * x; }
float twice(float y) { return y + y; } // expect-warning: function 'twice' is defined again with the same types: from here on, calls mean this one
float again(float x) { return again(x); } // expect-error: calls itself
float wrong_extern() {
  extern float nowhere; // expect-error: there is no such variable outside
  extern color P; // expect-error: extern 'P' is a point
  extern vector N; // expect-warning: extern 'N' is a normal
  return nowhere + comp(P, 0) + length(N);
}
surface s(float roughness = 0.1)
{
  float inner() { return roughness; } // expect-error: declare 'extern float roughness;'
  float blend = roughnes; // expect-error: did you mean 'roughness'?
  float blend = 2; // expect-error: declared twice
  float a[0] = {1}; // expect-error: must be a constant whole number
  float b[]; // expect-error: needs a length
  float c[2] = {1, 2, 3}; // expect-error: 3 values for array 'c' of 2 elements
  float d = {1}; // expect-error: 'd' is no array
  Ci = smothstep(0, 1, blend); // expect-error: did you mean 'smoothstep'?
  Ci = dot(N, I); // expect-error: RSL writes the dot product a . b
  Ci = nonsense_function(1); // expect-error: unknown function 'nonsense_function'
  Ci = later(1); // expect-error: used before its definition
  Ci = roughness(1); // expect-error: is a variable, not a function
}
float later(float x) { return x; }
surface s(float k) { Ci = k; } // expect-error: shader 's' is defined twice // expect-warning: parameter 'k' of shader 's' needs a default value; 0 is taken
float defaulted(float x = 1) { return x; } // expect-error: have no default values
