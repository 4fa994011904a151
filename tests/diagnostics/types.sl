// Types that do not fit.
surface s(float k = 1; string name = ""; float list[3] = {1, 2, 3})
{
  float f = Cs; // expect-error: a color cannot become the float 'f'
  color c = P; // expect-error: a point cannot become the color 'c'; write a cast
  c = Cs * P; // expect-error: cast one of them
  f = 2 ^ 3; // expect-error: write pow(x, y)
  f = 2 . 3; // expect-error: dot product of vectors or colors
  name + "a"; // expect-error: strings can only be compared
  f = list * 2; // expect-error: arrays are used element by element
  f = list; // expect-error: a whole array cannot be used here
  list = 1; // expect-error: cannot be assigned as a whole // expect-warning: parameter 'list' is read-only
  f = list[3]; // expect-error: index 3 is outside array 'list' of 3 elements
  f = k[0]; // expect-error: 'k' is no array
  f = {1, 2}; // expect-error: can only initialise an array
  f = k > 0 ? 1 : "a"; // expect-error: do not fit together
  f = float name; // expect-error: a string cannot be cast to float
  f = float list; // expect-error: an array cannot be cast
  f = float "world" k; // expect-error: belongs to no space
  if (P) f = 1; // expect-error: a point is no condition
  f = length(name); // expect-error: no 'length' takes (string)
  c = (1, "a", 2); // expect-error: a string cannot be used where a float is needed
  f = spline(k, 1, 2, 3); // expect-error: at least 4 knots
}
