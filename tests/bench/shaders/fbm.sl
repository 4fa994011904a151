/* Six octaves of noise, the sum that most procedural shaders begin with. */
surface fbm(float frequency = 4;) {
  point p = frequency * P;
  float sum = 0, amplitude = 1, octave;
  for (octave = 0; octave < 6; octave += 1) {
    sum += amplitude * (2 * float noise(p) - 1);
    p *= 2;
    amplitude *= 0.5;
  }
  Ci = 0.5 + 0.5 * sum;
  Oi = 1;
}
