#define A(x, y) x ## y
#define B A(B, A)
#if 1 +
surface (float x = {1, 2; color) { Ci = B(; ) + "unterminated
  if (((( x ) while for (;;) { break 7; continue -1; } return;
  float a[3] = { 1 }, a; a[99] = a; illuminance(1, 2, 3, 4, 5) { } solar() illuminate;
light l() { l(); } displacement d(output float x = x;) { P += x ^ x . x; }
