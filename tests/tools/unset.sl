/* Reads of what was never set, and reads that only look so. The test names line numbers. */
float last(float list[]) {
  return list[2];
}

void fill(output float list[]; output float x) {
  list[0] = list[1] = list[2] = x = 1;
}

float partly(float a) {
  float x;
  if (a > 0.4) x = 1;
  return x;                            /* line 13: at the first point */
}

surface unset(output varying float result = 0;) {
  float a[3], b[3], c[3], d[2], i;
  for (i = 0; i < 3; i += 1) a[i] = i;
  result = a[2 * u];
  b[1] = 1;
  result += b[2 * u];                  /* line 21: at both ends */
  fill(c, i);
  result += last(c) + i;
  d[0] += 1;                           /* line 24 */
  d[1] = d[1] + 1;                     /* line 25 */
  d = {1, 2};
  result += d[0] + partly(u);
  float sum;
  while (sum < 1) sum += 1;            /* line 29: the condition, and the sum of before */
  string which;
  if (u < 0.2) which = "a";
  result += sum;
  color tint;
  tint = color (1, u, 0);
  setcomp(tint, 2, 1);
  Ci = which == "" && u > 2 ? 0 : tint; /* line 36: set by then, at some points */
}
