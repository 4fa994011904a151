// Behind a '}' too many the rest of the shader is one error.
surface first(float k = 1) {
  if (k > 1)
    Ci = 1;
  }
  Oi = 1; // expect-error: expected a shader or a function, found 'Oi'; is there a '}' too many above?
  Ci *= Oi;
  if (k > 2) { Ci = 2; }
}
surface second(float k = 1) { Ci = k; }
