/* Neighbouring points take different branches and different numbers of rounds. */
surface divergent() {
  float shade;
  if (float noise(4 * P) > 0.5) {
    float x = 0, y = 0, rounds = 0;
    while (x * x + y * y < 4 && rounds < 24) {
      float next = x * x - y * y + 3 * s - 2.2;
      y = 2 * x * y + 2.4 * t - 1.2;
      x = next;
      rounds += 1;
    }
    shade = rounds / 24;
  } else {
    shade = 0.5 + 0.5 * sin(20 * s) * cos(20 * t);
  }
  Ci = color(shade, shade * shade, 1 - shade);
  Oi = 1;
}
