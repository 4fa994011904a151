/* Veins: turbulence of four octaves through a ramp of 13 colours. */
surface marble(float frequency = 3;) {
  point p = frequency * P;
  float turbulence = 0, scale = 1, octave;
  for (octave = 0; octave < 4; octave += 1) {
    turbulence += abs(2 * float noise(p * scale) - 1) / scale;
    scale *= 2;
  }
  Ci = spline(clamp(turbulence, 0, 1),
    color(0.10, 0.10, 0.14), color(0.10, 0.10, 0.14), color(0.22, 0.21, 0.26), color(0.40, 0.38, 0.42),
    color(0.62, 0.60, 0.60), color(0.70, 0.68, 0.66), color(0.78, 0.76, 0.73), color(0.82, 0.80, 0.77),
    color(0.86, 0.85, 0.82), color(0.90, 0.89, 0.87), color(0.93, 0.92, 0.91), color(0.96, 0.96, 0.95),
    color(0.96, 0.96, 0.95));
  Oi = 1;
}
