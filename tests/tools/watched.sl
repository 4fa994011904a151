/* What sltest says about lines: places where numbers are not finite, variables that were never set, lines and
   branches that do not run. The tests name line numbers. */
float ratio(float a, b) {
  return a / b;
}

float steps(uniform float n) {
  extern float u; float sum = 0, i;
  for (i = 0; i < n; i += 1) {
    sum += u * i;
  }
  return sum;
}

float unused(float a) {
  return a + 1;
}

surface watched(float k = 1; varying float big = 1; output varying float result = 0;) {
  float x;
  color tint;
  float list[2] = {u, 4};
  if (u > 0.4) {
    x = ratio(1, u - 0.5);
  }
  if (k > 2)
    tint = color(1, 0, 0);
  else
    tint = 0.5;
  result = x;
  result += steps(3) + list[1] + big;
  Ci = tint * (v > 2 ? 0 : 1);
}
