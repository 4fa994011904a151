// Heads of shaders and functions.
Ci = 1; // expect-error: expected a shader or a function, found 'Ci'
surface no_parens { // expect-error: a shader has parentheses behind its name, with or without parameters: surface no_parens()
  Ci = 1;
}
surface (float k = 1) { // expect-error: a name is missing: surface name(...)
  Ci = k;
}
surface no_comma(float Kd = 1 float Ks = 0.5) { // expect-error: expected ',' or ';', found 'float'
  Ci = Kd * Ks;
}
surface no_type(float Kd = 1; Ks = 0.5) { Ci = Kd * Ks; } // expect-error: the type of 'Ks' is missing
surface type_for_name(float Kd = 1, color = 0.5) { Ci = Kd; } // expect-error: 'color' cannot be a name: it is a word of the language
float sum(x, y) { return x + y; } // expect-error: the type of 'x' is missing
surface unknown_type(flaot a = 1; thing b = 2) { Ci = sum(a, b); } // expect-error: unknown type 'flaot'; did you mean 'float'? // expect-error: unknown type 'thing'; did you mean 'string'?
surface wrong_array(float k[] = 1; float m[3] = 2) { Ci = m[0]; } // expect-error: array 'k' needs a length or a list of initial values; arrays that grow belong to RSL 2.0, which is not supported
surface wrong_list(color c = {1, 0, 0}; color d = (1, 0)) { Ci = c * d; } // expect-error: 'c' is no array: a list of values in braces cannot initialise it // expect-error: 2 values in parentheses: a triple has 3, a matrix 16
surface triple(color c = 1) { color d = 1, 0, 0; uniform = 3; float for = 1; Ci = c * d; } // expect-error: 'for' cannot be a name // expect-error: expected a name, found '0'; a triple stands in parentheses, (1, 0, 0), and decimals have a point // expect-error: expected a type, found '='
transformation bend() { P += N; } // expect-error: 'transformation' is neither a kind of shader (surface, displacement, light, volume, imager) nor a type
surface no_braces(float k = 1)
  Ci = k; // expect-error: expected '{', found 'Ci'
