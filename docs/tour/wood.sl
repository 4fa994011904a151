/* wood.sl: rings round the z axis of shader space, made uneven by noise. */
surface wood(float rings = 10; color light = color(0.7, 0.45, 0.25), dark = color(0.35, 0.2, 0.1)) {
  point p = transform("shader", P);
  float r = rings * sqrt(xcomp(p) * xcomp(p) + ycomp(p) * ycomp(p)) + 0.5 * noise(4 * p);
  Oi = Os;
  Ci = Os * mix(light, dark, smoothstep(0.2, 0.9, mod(r, 1)));
}
