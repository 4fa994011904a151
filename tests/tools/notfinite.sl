/* A parameter with an element that is not finite, and a local array of such. The test names line numbers. */
surface notfinite(uniform float list[3] = {1, 2, 3}; output varying float result = 0;) {
  float local[2] = {1, 1};
  local[1] = log(0 * u);               /* line 4 */
  result = local[1] + list[2 * u];     /* line 5 */
}
