// Words and signs of other languages still.
surface statements(float k = 1)
{
  if (k > 1) Ci = 1;
  elseif (k > 2) Ci = 2; // expect-error: the shading language has no 'elseif': write 'else if'
  elif (k > 3) Ci = 3; // expect-error: the shading language has no 'elif': write 'else if'
  else Ci = 0;
  if (k > 1) then Ci = 1; // expect-error: the shading language has no 'then': leave it out
  if (k > 1 and k < 2 or k > 3) Ci = 1; // expect-error: the shading language has no operator 'and': logical 'and' is && // expect-error: the shading language has no operator 'or': logical 'or' is ||
  if (not k) Ci = 1; // expect-error: the shading language has no operator 'not': logical 'not' is !
  unless (k > 1) Ci = 2; // expect-error: the shading language has no 'unless': write if (!(...)) ...
  if (k =< 1) Ci = 1; // expect-error: the shading language has no operator '=<': less or equal is <=
  if (k => 1) Ci = 1; // expect-error: the shading language has no operator '=>': greater or equal is >=
  if (k <> 1) Ci = 1; // expect-error: the shading language has no operator '<>': not equal is !=
  if (k === 1) Ci = 1; // expect-error: the shading language has no operator '===': equal is ==
  Ci = s ** 2; // expect-error: the shading language has no operator '**': write pow(a, b)
  float x = if (k > 1) 1 else 2; // expect-error: 'if' is no value; a choice between two values is written: condition ? a : b
  float german = 1,5; // expect-error: expected a name, found '5'; a triple stands in parentheses, (1, 0, 0), and decimals have a point
}
surface quotes(string a = 'wood'; string b = “wood”) // expect-error: strings stand in double quotes // expect-error: '“' is a character of typography: write '"'
{
  Ci = texture(a) – texture(b) × 2; // expect-error: '–' is a character of typography: write '-' // expect-error: '×' is a character of typography: write '*'
}
surface calls(string map = "a.tex")
{
  float x = sqrt 4; // expect-error: the arguments of 'sqrt' stand in parentheses: sqrt(...)
  normal Nn = normalize N; // expect-error: the arguments of 'normalize' stand in parentheses
  Ci = texture map; // expect-error: the arguments of 'texture' stand in parentheses
  Ci = (color) P * (float) x; // expect-error: a cast has no parentheses around the type: write color // expect-error: write float
  Ci = ambient; // expect-error: there is no variable 'ambient': it is a function
}
