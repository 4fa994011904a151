// Arguments that do not fit, in number, type and order.
surface arguments(float k = 1; string base = "wood") {
  float x = smoothstep(s, 0.2); // expect-error: no 'smoothstep' takes 2 arguments
  color c = mix(0.5, "a", Os); // expect-error: no 'mix' takes (float, string, color)
  c = texture(s, t, "wood.tex"); // expect-error: no 'texture' takes (float, float, string)
  c = specular(0.1, N, -I); // expect-error: no 'specular' takes (float, normal, vector)
  normal n = faceforward(I); // expect-error: no 'faceforward' takes 1 argument
  printf("k is %f\n"); // expect-error: the pattern has 1 conversion for 0 values
  printf("%d and %s\n", k, k); // expect-error: '%s' cannot print a float
  printf(k); // expect-error: no 'printf' takes (float)
  string name = base + ".tex", number = k; // expect-error: operator '+' cannot take (string, string); strings can only be compared with == and !=, and joined with concat() // expect-error: a float cannot become the string 'number'; format("%g", x) makes a text of a number
  if (base > "a") x = 1; // expect-error: operator '>' cannot take (string, string); strings can only be compared with == and !=, and joined with concat()
  x = N * I; // expect-error: a vector cannot become the float 'x'; take a component, or length()
  x = N . k; // expect-error: operator '.' cannot take (normal, float); '.' is the dot product of vectors or colors
  c = Cs ^ k; // expect-error: operator '^' cannot take (color, float); '^' is the cross product of vectors: for a power write pow(x, y)
  c = k > 1 ? Cs : P; // expect-error: the two sides of '?:' are of types that do not fit together: (color, point)
  c = k > 1 ? Cs; // expect-error: expected ':', found ';'
  matrix m = (1, 0, 0, 0, 1, 0, 0, 0, 1); // expect-error: 9 values in parentheses: a triple has 3, a matrix 16
  x = m[0]; // expect-error: 'm' is no array; its elements are comp(m, row, column)
  x = max(1, 2,); // expect-error: expected an expression, found ')'
  c = k diffuse(N); // expect-error: expected ';' or an operator, found 'diffuse'
  print("x"); // expect-error: there is no function 'print': use printf("%f", x)
}
